#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipeline/extract/body_region.h"
#include "pipeline/extract/extract.h"
#include "scenes/random.h"

namespace dressform {

// One view of the stage: what goes in, and what comes out.
struct ViewTask {
  std::string sensor;
  const SensorCalibration* calibration = nullptr;
  const Shot *naked = nullptr, *dressed = nullptr;  // null: none
  BodyExpectation expected;
  std::optional<double> azimuth_deg;  // of the sensor round the mannequin by the rig prior: 0 in front, 180 behind
  ViewMasks masks;                    // empty ones
  std::optional<Eigen::Vector4d> floor;
};

// A task for every sensor of the session. Throws InputError for one without a calibration.
std::vector<ViewTask> view_tasks(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked);

struct ViewFloorParams {
  double tolerance_m = 0.02;
  double tilt_deg = 20;
};
template <class V>
void floor_fields(V& v, ViewFloorParams& p) {
  v("floor_tolerance_m", p.tolerance_m, 0.002, 0.1, "m", "distance of the floor's inliers");
  v("floor_tilt_deg", p.tilt_deg, 2, 60, "deg", "largest angle between the floor and the sensor's horizon");
}

// The floor among the points of one shot (sensor frame, m), kept in the task where one is found: that of the later
// shot.
std::optional<Eigen::Vector4d> floor_of_view(const cv::Mat& points_m, const ViewFloorParams& params, ViewTask& task,
                                             Seed seed);

// The stage's result.
ExtractedViews extracted_views(const std::vector<ViewTask>& tasks);

}  // namespace dressform
