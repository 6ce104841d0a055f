#include "pipeline/reconstruct.h"

#include "pipeline/multipath/apply.h"
#include "pipeline/run/picks_in_model.h"
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
  return {corrected_hash(session.content_hash(), calibration.content_hash(),
                         {known.signal_counts, known.infrared_scaled ? 1.0 : 0.0, known.floor_albedo,
                          known.other_albedo, known.shots.factor}),
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

// A body with its landmarks, as the stages are given it.
LazyArtifact<KnownBody> with_landmarks(const LazyArtifact<BodyModel>& model, const LazyArtifact<Landmarks>& landmarks) {
  return {hash_hex(model.content_hash() + "/" + landmarks.content_hash()), [model, landmarks] {
            return KnownBody{model.get().body, landmarks.get()};
          }};
}

// Which way the mannequin faces, by the rig; the user, by the mannequin.
LazyArtifact<FacingClues> facing_by_rig(const LazyArtifact<CaptureSession>& session,
                                        const LazyArtifact<Registration>& registration) {
  return {hash_hex(session.content_hash() + "/" + registration.content_hash() + "/facing"), [session, registration] {
            return FacingClues{front_from_rig(session.get().prior, registration.get()), {}};
          }};
}

// What garments there are, as segment found them; and as they lie on the mannequin once they are open.
LazyArtifact<GarmentLayouts> layouts_of(const LazyArtifact<Segmentation>& segmentation) {
  return {hash_hex(segmentation.content_hash() + "/garments"), [segmentation] { return segmentation.get().garments; }};
}
LazyArtifact<GarmentLayouts> layouts_of(const LazyArtifact<OpenGarments>& opened) {
  return {hash_hex(opened.content_hash() + "/garments"), [opened] {
            GarmentLayouts layouts;
            for (const auto& [name, garment] : opened.get().garments) layouts[name] = garment.layout;
            return layouts;
          }};
}

LazyArtifact<FacingClues> facing_like(const LazyArtifact<KnownBody>& known) {
  return {hash_hex(known.content_hash() + "/facing"), [known] { return FacingClues{{}, known.get()}; }};
}

}  // namespace

Reconstruction reconstruct(const SessionSource& source, const ReconstructionOptions& options, ArtifactStore& store,
                           const StageProgress& progress, const GivenArtifacts& given) {
  check_options(options);
  check_picks(options, source);
  StageRunner runner(options, store, progress, given);
  if (source.picks) runner.set_picks(*source.picks);

  const auto calibrated = runner.run<Calibrate>("calibrate", source.session);
  const auto calibration = cameras_of(calibrated);
  const auto multipath = runner.run<EstimateMultipath>("multipath", source.session, calibration);
  const auto session = corrected(source.session, calibration, multipath);
  const auto scanner = calibration_of(calibration, source.scan_naked_sensor);
  const auto scan_naked = corrected(source.scan_naked, scanner, multipath, "scan_naked");
  const auto naked = runner.run<Fuse>("fuse_naked", scan_naked, scanner);
  const auto extracted = runner.run<Extract>("extract", session, calibration, naked);
  const auto registration = runner.run<Register>("registration", session, calibration, naked, extracted);
  if (source.picks) runner.set_picks(in_model_frame(*source.picks, naked, registration));
  const auto landmarks =
      runner.run<FindLandmarks>("landmarks_naked", naked, facing_by_rig(source.session, registration));
  const auto body = with_landmarks(naked, landmarks);
  const auto segmentation = runner.run<Segment>("segment", session, calibration, body, extracted, registration);
  const auto filled = runner.run<Fill>("fill", session, calibration, body, registration, segmentation);
  const auto closed =
      runner.run<Surface>("surface", session, calibration, body, registration, filled, layouts_of(segmentation));
  const auto opened = runner.run<Open>("open", session, calibration, body, registration, segmentation, closed);
  const auto textured = runner.run<Texture>("texture", session, calibration, naked, registration, filled, opened);
  Reconstruction result{source.sensors, calibrated, calibration,  multipath, naked,  extracted,
                        registration,   landmarks,  segmentation, filled,    closed, opened,
                        textured,       {},         {},           {},        {},     {}};
  if (source.scan_user) {
    const auto user_scanner = calibration_of(calibration, source.scan_user_sensor);
    result.user =
        runner.run<Fuse>("fuse_user", corrected(*source.scan_user, user_scanner, multipath, "scan_user"), user_scanner);
    result.user_landmarks = runner.run<FindLandmarks>("landmarks_user", *result.user, facing_like(body));
    const auto user = with_landmarks(*result.user, *result.user_landmarks);
    if (source.picks) runner.set_picks(in_model_frame(*source.picks, naked, registration, *result.user));
    result.fitted = runner.run<Fit>("fit", body, user, textured, layouts_of(opened));
    result.corrected = runner.run<Correct>("correct", user, *result.fitted);
  }
  result.records = runner.records();
  return result;
}

}  // namespace dressform
