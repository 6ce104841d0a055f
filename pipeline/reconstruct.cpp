#include "pipeline/reconstruct.h"

#include "pipeline/multipath/apply.h"
#include "pipeline/run/stage_runner.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

// The cameras alone: stages do not see how they were found.
LazyArtifact<Calibration> cameras_of(const LazyArtifact<Calibrated>& calibrated) {
  return {hash_hex(calibrated.content_hash() + "/cameras"), [calibrated] { return calibrated.get().calibration; }};
}

// The calibration of the sensor that made a scan.
LazyArtifact<SensorCalibration> calibration_of(const LazyArtifact<Calibration>& calibration,
                                               const std::string& sensor) {
  return {hash_hex(calibration.content_hash() + "/" + sensor), [calibration, sensor] {
            const auto& sensors = calibration.get().sensors;
            const auto found = sensors.find(sensor);
            if (found == sensors.end())
              throw InputError("calibration.json: sensors", "no \"" + sensor + "\"; expected the sensor of the scan");
            return found->second;
          }};
}

// Corrected images are no artifacts: they are made again from the session when a stage that has to run asks for them.
// Without bounced light the images, and so all that follows, stay the same.
std::string corrected_hash(const std::string& images, const std::string& calibration,
                           const std::vector<double>& numbers) {
  return hash_hex(images + "/" + calibration + "/" + to_bytes(numbers) + "/" + code_version(EstimateMultipath::name()));
}

LazyArtifact<CaptureSession> corrected(const LazyArtifact<CaptureSession>& session,
                                       const LazyArtifact<Calibration>& calibration,
                                       const LazyArtifact<Multipath>& multipath) {
  if (multipath.get().shots.factor == 0) return session;
  const auto& known = multipath.get();
  return {corrected_hash(session.content_hash(), calibration.content_hash(), {known.signal_counts, known.shots.factor}),
          [session, calibration, multipath] {
            return without_multipath(session.get(), calibration.get(), multipath.get());
          }};
}

LazyArtifact<DepthScan> corrected(const LazyArtifact<DepthScan>& scan, const LazyArtifact<SensorCalibration>& sensor,
                                  const LazyArtifact<Multipath>& multipath, const std::string& name) {
  const auto& known = multipath.get();
  const auto found = known.scans.find(name);
  if (found == known.scans.end() || found->second.factor == 0) return scan;
  const BounceStrength strength = found->second;
  return {corrected_hash(scan.content_hash(), sensor.content_hash(),
                         {known.floor_albedo, known.other_albedo, strength.factor}),
          [scan, sensor, multipath, strength] {
            return without_multipath(scan.get(), sensor.get(), multipath.get(), strength);
          }};
}

}  // namespace

Reconstruction reconstruct(const SessionSource& source, const ReconstructionOptions& options, ArtifactStore& store,
                           const StageProgress& progress) {
  check_options(options);
  StageRunner runner(options, store, progress);

  const auto calibrated = runner.run<Calibrate>("calibrate", source.session);
  const auto calibration = cameras_of(calibrated);
  const auto multipath = runner.run<EstimateMultipath>("multipath", source.session, calibration);
  const auto session = corrected(source.session, calibration, multipath);
  const auto scanner = calibration_of(calibration, source.scan_naked_sensor);
  const auto scan_naked = corrected(source.scan_naked, scanner, multipath, "scan_naked");
  const auto naked = runner.run<Fuse>("fuse_naked", scan_naked, scanner);
  const auto extracted = runner.run<Extract>("extract", session, calibration, naked);
  const auto registration = runner.run<Register>("registration", session, calibration, naked, extracted);
  const auto segmentation = runner.run<Segment>("segment", session, calibration, naked, extracted, registration);
  const auto filled = runner.run<Fill>("fill", session, calibration, naked, registration, segmentation);
  const auto closed = runner.run<Surface>("surface", session, calibration, naked, registration, filled);
  const auto opened = runner.run<Open>("open", session, calibration, naked, registration, segmentation, closed);
  const auto textured = runner.run<Texture>("texture", session, calibration, naked, registration, filled, opened);
  Reconstruction result{
      source.sensors, calibrated, calibration, multipath, naked, extracted, registration, segmentation,
      filled,         closed,     opened,      textured,  {},    {},        {},           {}};
  if (source.scan_user) {
    const auto user_scanner = calibration_of(calibration, source.scan_user_sensor);
    result.user =
        runner.run<Fuse>("fuse_user", corrected(*source.scan_user, user_scanner, multipath, "scan_user"), user_scanner);
    result.fitted = runner.run<Fit>("fit", naked, *result.user, textured);
    result.corrected = runner.run<Correct>("correct", *result.user, *result.fitted);
  }
  result.records = runner.records();
  return result;
}

}  // namespace dressform
