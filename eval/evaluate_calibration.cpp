#include <array>
#include <limits>

#include "eval/evaluate_parts.h"
#include "eval/metrics/calibration_metrics.h"

namespace dressform::evaluation {
using namespace metrics;

namespace {

struct Value {
  const char* name;
  const char* unit;
};
constexpr std::array<Value, 11> kValues{{{"ir_focal_error_percent@1", "%"},
                                         {"ir_principal_point_px@1", "px"},
                                         {"color_focal_error_percent@1", "%"},
                                         {"color_principal_point_px@1", "px"},
                                         {"color_from_ir_deg@1", "deg"},
                                         {"color_from_ir_mm@1", "mm"},
                                         {"depth_offset_mm@1", "mm"},
                                         {"point_mm@1", "mm"},
                                         {"mapping_px@1", "px"},
                                         {"ir_reprojection_rms_px@1", "px"},
                                         {"color_reprojection_rms_px@1", "px"}}};
constexpr std::size_t kFirstOfBoards = 9;
using Values = std::array<std::optional<double>, kValues.size()>;  // empty: there is no such thing

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
  for (std::size_t k = 0; k < kValues.size(); ++k) {
    const std::string metric = sensor + "/" + kValues[k].name;
    if (values[k])
      rows.add(metric, kValues[k].unit, *values[k]);
    else
      rows.absent(metric, kValues[k].unit);
  }
}

}  // namespace

std::vector<ScoreRow> calibration(const RunOutputs& outputs, const GroundTruth& truth) {
  StageRows rows("calibrate");
  Values worst;
  bool all = true;
  for (const auto& [sensor, pose] : truth.world_from_sensor) {
    if (!truth.calibration || !truth.calibration->sensors.count(sensor)) {
      add_values(rows, sensor, {});
    } else if (!outputs.calibration || !outputs.calibration->sensors.count(sensor)) {
      all = false;
      for (const auto& value : kValues) rows.fail(sensor + "/" + value.name, value.unit);
    } else {
      const Values values = values_of(outputs, sensor, truth.calibration->sensors.at(sensor));
      add_values(rows, sensor, values);
      for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k]) worst[k] = std::max(worst[k].value_or(0), *values[k]);
    }
  }
  if (all)
    add_values(rows, "max", worst);
  else
    for (const auto& value : kValues) rows.fail(std::string("max/") + value.name, value.unit);
  return rows.rows;
}

}  // namespace dressform::evaluation
