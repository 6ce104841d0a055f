#include <algorithm>
#include <array>

#include "eval/metrics/calibration_metrics.h"
#include "eval/score/metric_family.h"

namespace dressform {
namespace {
using namespace metrics;

void judge_calibrate(const Judged& run, StageRows& rows);

// Each of a sensor and of the worst one.
const MetricFamily calibrate_metrics{
    "calibrate",
    "calibrate",
    {{"<sensor>/ir_focal_error_percent", 1, "%", Better::lower,
      "The larger of abs(fx / true - 1) and abs(fy / true - 1) of the infrared camera. Sensor \"max\" is the worst "
      "one. All rows of this stage are absent where the truth has no calibration of its own (a scene without boards "
      "and errors)."},
     {"<sensor>/ir_principal_point_px", 1, "px", Better::lower,
      "Distance of the principal points of the infrared camera."},
     {"<sensor>/color_focal_error_percent", 1, "%", Better::lower, "As ir_focal_error_percent, of the colour camera."},
     {"<sensor>/color_principal_point_px", 1, "px", Better::lower, "As ir_principal_point_px, of the colour camera."},
     {"<sensor>/color_from_ir_deg", 1, "deg", Better::lower, "Angle of the rotation error between the two cameras."},
     {"<sensor>/color_from_ir_mm", 1, "mm", Better::lower, "Translation error between the two cameras."},
     {"<sensor>/depth_offset_mm", 1, "mm", Better::lower, "Absolute difference of the depth offsets."},
     {"<sensor>/point_mm", 1, "mm", Better::lower,
      "Root mean square, over the infrared image at a true depth of 2.1 m, of the error of the point."},
     {"<sensor>/mapping_px", 1, "px", Better::lower, "The same of the point's place in the colour image."},
     Metric{"<sensor>/ir_reprojection_rms_px", 1, "px", Better::lower,
            "Root mean square distance of the corners of the boards that the run used; absent where it used none."}
         .after("Zhang, PAMI 2000"),
     {"<sensor>/color_reprojection_rms_px", 1, "px", Better::lower,
      "As ir_reprojection_rms_px, of the colour camera."}},
    judge_calibrate};

constexpr std::size_t kValues = 11, kFirstOfBoards = 9;     // in the order of the declarations
using Values = std::array<std::optional<double>, kValues>;  // empty: there is no such thing

Values values_of(const RunOutputs& outputs, const std::string& sensor, const SensorCalibration& truth) {
  const SensorErrors errors = sensor_errors(outputs.calibration->sensors.at(sensor), truth);
  Values values;
  values[0] = errors.ir.focal_percent;
  values[1] = errors.ir.principal_px;
  if (errors.color) {
    values[2] = errors.color->focal_percent;
    values[3] = errors.color->principal_px;
    values[4] = errors.color_from_ir_deg;
    values[5] = errors.color_from_ir_mm;
    values[8] = errors.mapping_px;
  }
  values[6] = errors.depth_offset_mm;
  values[7] = errors.point_mm;
  const auto boards = outputs.boards.find(sensor);
  if (boards == outputs.boards.end()) return values;
  values[kFirstOfBoards] = boards->second.ir_rms_px;
  if (errors.color) values[kFirstOfBoards + 1] = boards->second.color_rms_px;
  return values;
}

void add_values(StageRows& rows, const std::string& sensor, const Values& values) {
  for (std::size_t k = 0; k < kValues; ++k) {
    const std::string& metric = calibrate_metrics.metrics()[k].name;
    if (values[k])
      rows.add(metric, {sensor}, *values[k]);
    else
      rows.absent(metric, {sensor});
  }
}

void fail_values(StageRows& rows, const std::string& sensor) {
  for (const Metric& metric : calibrate_metrics.metrics()) rows.fail(metric.name, {sensor});
}

void judge_calibrate(const Judged& run, StageRows& rows) {
  Values worst;
  bool all = true;
  for (const auto& [sensor, pose] : run.truth.world_from_sensor) {
    if (!run.truth.calibration || !run.truth.calibration->sensors.count(sensor)) {
      add_values(rows, sensor, {});
    } else if (!run.outputs.calibration || !run.outputs.calibration->sensors.count(sensor)) {
      all = false;
      fail_values(rows, sensor);
    } else {
      const Values values = values_of(run.outputs, sensor, run.truth.calibration->sensors.at(sensor));
      add_values(rows, sensor, values);
      for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k]) worst[k] = std::max(worst[k].value_or(0), *values[k]);
    }
  }
  if (all)
    add_values(rows, "max", worst);
  else
    fail_values(rows, "max");
}

}  // namespace
}  // namespace dressform
