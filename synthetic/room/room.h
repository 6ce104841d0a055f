#pragma once
#include <vector>

#include "scenes/scene.h"
#include "synthetic/body/body.h"
#include "synthetic/capture/surface.h"

namespace dressform {

// Floor, walls, ceiling, skirting, door and a window; with `furniture` also pieces along the walls, out of the way of
// the rig. World frame, floor at y = 0.
std::vector<RaySurface> make_room(const RoomSpec& room);

// The bulbs' own glass: seen by cameras, casting no shadow (it lies within what a shadow ray leaves out).
std::vector<RaySurface> make_bulbs(const std::vector<LightSpec>& lights);

// The chrome stand: a base plate under the feet and a rod that holds the calf.
std::vector<RaySurface> make_stand(const Body& body);

// The other sensors as a camera sees them: housings on tripods.
std::vector<RaySurface> make_rig_hardware(const std::vector<SensorSpec>& rig);

}  // namespace dressform
