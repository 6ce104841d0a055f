#pragma once
#include <string>
#include <vector>

#include "scenes/scene_fields.h"

namespace dressform {

// What a drawn scene is asked to be like; the rest is drawn.
struct DrawOptions {
  std::string people = "any", clothes = "any", prints = "any", rooms = "any";
  int sensors = 0;
  std::string sensor_model = "kinect_v2";
  std::vector<std::string> strata;  // all of these at once
};
template <class V>
void fields(V& v, DrawOptions& options) {
  v("people", options.people, {"any", "man", "woman"}, "who wears the clothes");
  v("clothes", options.clothes, {"any", "trousers", "shorts", "skirt", "dress"},
    "what is worn beneath a shirt; a dress");
  v("prints", options.prints, {"any", "plain", "busy"}, "how the cloth is printed");
  v("rooms", options.rooms, {"any", "small", "large"}, "how close the walls are");
  v("sensors", options.sensors, 0, 8, "", "how many sensors stand round the body, 3 to 8; 0: any number");
  v("sensor_model", options.sensor_model, {}, "sensor model: dressform variants sensor");
}

// A sensor of the rig: its cameras, and where it stands.
struct DrawnSensor {
  SensorSpec spec;  // without its place
  SensorPlace place;
};

// A scene as drawn: every number is what the TOML says.
struct DrawnScene {
  std::string name, description;
  RoomSpec room;
  std::vector<LightSpec> lights;
  BodySpec body, user;  // measures given, not sampled
  std::vector<GarmentSpec> garments;
  std::vector<DrawnSensor> rig;
  ScanSpec scan;
  PriorSpec prior;
  std::string sensor_model;
};

// The strata that can be asked for, with what each means.
struct Stratum {
  const char* name;
  const char* meaning;
};
const std::vector<Stratum>& known_strata();

// Draws body, pose, clothes, prints, room and rig as people and their rooms differ: bodies of the survey of
// synthetic/body/survey.h, clothes of any cut that the program sews, rigs of 3 to 8. Deterministic in (options, seed);
// a choice that is fixed by an option leaves the other draws as they are. Throws InputError for options that are not
// known or exclude each other.
DrawnScene draw_scene(const DrawOptions& options, Seed seed);

// The strata that a scene belongs to, asked for or by chance, in the order of known_strata().
std::vector<std::string> strata_of(const DrawnScene& scene);

// A scene file that holds all of it, to be read and changed by people.
std::string scene_toml(const DrawnScene& scene);

}  // namespace dressform
