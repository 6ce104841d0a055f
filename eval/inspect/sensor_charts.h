#pragma once
#include "eval/inspect/inspection.h"
#include "synthetic/sensors/noise_statistics.h"

namespace dressform {

// One section each: a chart of what the model does, with the published figures where there are some. `noise` has the
// model's noise alone, `still` what is left without it.

InspectionSection sigma_by_distance(const SensorSetup& noise);
InspectionSection sigma_by_angle(const SensorSetup& noise);
InspectionSection sigma_by_albedo(const SensorSetup& noise);
InspectionSection holes_by_angle(const SensorSetup& noise);
InspectionSection flying_by_gap(const SensorSetup& noise);
InspectionSection autocorrelation(const SensorSetup& noise);
InspectionSection decoding_by_distance(const SensorSetup& still);
// Of models that have the parameter `clip`.
InspectionSection wiggling(const SensorSetup& still);
// Of kinect_v1.
InspectionSection levels(const SensorSetup& noise);

}  // namespace dressform
