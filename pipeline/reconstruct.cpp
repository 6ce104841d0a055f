#include "pipeline/reconstruct.h"

#include "pipeline/road.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

// The cameras alone: stages do not see how they were found.
Made<Calibration> cameras_of(const Made<Calibrated>& calibrated) {
  return {hash_hex(calibrated.content_hash() + "/cameras"), [calibrated] { return calibrated.get().calibration; }};
}

// The calibration of the sensor that made a scan.
Made<SensorCalibration> calibration_of(const Made<Calibration>& calibration, const std::string& sensor) {
  return {hash_hex(calibration.content_hash() + "/" + sensor), [calibration, sensor] {
            const auto& sensors = calibration.get().sensors;
            const auto found = sensors.find(sensor);
            if (found == sensors.end())
              throw InputError("calibration.json: sensors", "no \"" + sensor + "\"; expected the sensor of the scan");
            return found->second;
          }};
}

}  // namespace

Reconstruction reconstruct(const SessionSource& source, const ReconstructionOptions& options, ArtifactStore& store,
                           const StageProgress& progress) {
  check_options(options);
  Road road(options, store, progress);
  const auto& session = source.session;

  const auto calibrated = road.run<Calibrate>("calibrate", session);
  const auto calibration = cameras_of(calibrated);
  const auto scanner = calibration_of(calibration, source.scan_naked_sensor);
  const auto naked = road.run<Fuse>("fuse_naked", source.scan_naked, scanner);
  const auto extracted = road.run<Extract>("extract", session, calibration, naked);
  const auto registration = road.run<Register>("registration", session, calibration, naked, extracted);
  const auto segmentation = road.run<Segment>("segment", session, calibration, naked, extracted, registration);
  const auto filled = road.run<Fill>("fill", session, calibration, naked, registration, segmentation);
  const auto closed = road.run<Surface>("surface", session, calibration, naked, registration, filled);
  const auto opened = road.run<Open>("open", session, calibration, naked, registration, segmentation, closed);
  const auto textured = road.run<Texture>("texture", session, calibration, naked, registration, filled, opened);
  Reconstruction result{source.sensors, calibrated,   calibration, naked,  extracted,
                        registration,   segmentation, filled,      closed, opened,
                        textured,       {},           {},          {},     {}};
  if (source.scan_user) {
    const auto user_scanner = calibration_of(calibration, source.scan_user_sensor);
    result.user = road.run<Fuse>("fuse_user", *source.scan_user, user_scanner);
    result.fitted = road.run<Fit>("fit", naked, *result.user, textured);
    result.corrected = road.run<Correct>("correct", *result.user, *result.fitted);
  }
  result.records = road.records();
  return result;
}

}  // namespace dressform
