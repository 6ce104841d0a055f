#pragma once
#include "eval/inspect/inspection.h"
#include "synthetic/sensors/noise_statistics.h"

namespace dressform {

// One section each: a chart of what the model does beside what is known of its device, and the figures it is held to
// where there are some. `noise` has the model's noise alone, `still` what is left without it.

// sensor_noise_charts.cpp
InspectionSection sigma_by_distance(const SensorSetup& noise);
InspectionSection sigma_by_angle(const SensorSetup& noise);
InspectionSection sigma_by_albedo(const SensorSetup& noise);
InspectionSection autocorrelation(const SensorSetup& noise);
// sensor_charts.cpp
InspectionSection holes_by_angle(const SensorSetup& noise);
InspectionSection flying_by_gap(const SensorSetup& noise);
InspectionSection decoding_by_distance(const SensorSetup& still);
// Of models that have the parameter `clip`.
InspectionSection wiggling(const SensorSetup& still);
// Of devices that can measure some depths only.
InspectionSection levels(const SensorSetup& noise);

}  // namespace dressform
