#pragma once
#include <map>
#include <string>

#include "pipeline/multipath/bounce_field.h"
#include "pipeline/multipath/multipath.h"

namespace dressform {

using SensorOptics = std::map<std::string, DepthOptics>;  // by sensor

// Of the sensors that measure by time of flight.
SensorOptics time_of_flight_optics(const Calibration& calibration);

// By cell: the floor's below, the other's elsewhere, for images without an infrared image.
std::vector<float> assumed_albedo(const SurfaceCells& cells, const Multipath& known);

// The same session with bounced light taken off the depth of its shots; scans are left as they are.
CaptureSession without_multipath(const CaptureSession& session, const Calibration& calibration,
                                 const Multipath& multipath);
// The same scan without it. `strength`: multipath.scans' own.
DepthScan without_multipath(const DepthScan& scan, const SensorCalibration& calibration, const Multipath& multipath,
                            const BounceStrength& strength);

}  // namespace dressform
