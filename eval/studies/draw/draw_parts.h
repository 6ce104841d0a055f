#pragma once
#include "eval/studies/draw/dice.h"
#include "eval/studies/draw/draw_scene.h"

namespace dressform {

// Who is drawn: the options with the strata taken in.
struct DrawnWishes {
  std::string people, clothes, prints, rooms;
  int sensors = 0;
  std::string sensor_model;
  bool tucked = false, long_sleeves = false, same_colors = false, stout = false, child = false;
};

// A body with given measures. Wearers stand as dummies do; customers with their arms a little out.
BodySpec draw_wearer(const DrawnWishes& wishes, const Dice& dice);
BodySpec draw_customer(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice);
// Waist more than this many deviations above the mean of the sex.
constexpr double kStoutDeviations = 1.3;
bool is_stout(const BodySpec& body);
constexpr double kChildBelow_m = 1.5;

std::vector<GarmentSpec> draw_clothes(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice);
// Whether two garments' ground colours are hard to tell apart.
bool colors_alike(const GarmentSpec& a, const GarmentSpec& b);

std::vector<DrawnSensor> draw_rig(const DrawnWishes& wishes, const BodySpec& wearer, const Dice& dice);
ScanSpec draw_scan(const DrawnWishes& wishes, const Dice& dice);
// A room that holds the rig and the walk of the scan.
RoomSpec draw_room(const DrawnWishes& wishes, const std::vector<DrawnSensor>& rig, const ScanSpec& scan,
                   const Dice& dice);
std::vector<LightSpec> draw_lights(const RoomSpec& room, const Dice& dice);

}  // namespace dressform
