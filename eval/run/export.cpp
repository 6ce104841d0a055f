#include "eval/run/export.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "eval/run/calibrated_json.h"
#include "eval/run/garments_json.h"
#include "eval/run/rough_colors.h"
#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kColorReach_m = 0.015;  // from a closed surface to the points that colour it

json rows_of(const Isometry3d& transform) {
  json rows = json::array();
  for (int r = 0; r < 4; ++r) {
    json row = json::array();
    for (int c = 0; c < 4; ++c) row.push_back(transform.matrix()(r, c));
    rows.push_back(row);
  }
  return rows;
}

std::string registration_json(const Reconstruction& reconstruction) {
  const auto& registration = reconstruction.registration.get();
  json text = {{"model_from_sensor", json::object()}, {"converged", json::object()}};
  for (const auto& [sensor, pose] : registration.model_from_sensor) text["model_from_sensor"][sensor] = rows_of(pose);
  for (const auto& sensor : reconstruction.sensors) {
    const auto found = registration.converged.find(sensor);
    text["converged"][sensor] = found != registration.converged.end() && found->second;
  }
  for (const auto& [sensor, why] : registration.problem) text["problem"][sensor] = why;
  for (const auto& [sensor, evidence] : registration.evidence)
    text["evidence"][sensor] = {
        {"inlier_part", evidence.inlier_part},
        {"residual_over_noise", evidence.residual_over_noise},
        {"rotation_sigma_deg", std::isfinite(evidence.rotation_sigma_deg) ? json(evidence.rotation_sigma_deg) : json()},
        {"translation_sigma_m",
         std::isfinite(evidence.translation_sigma_m) ? json(evidence.translation_sigma_m) : json()}};
  if (reconstruction.user && !reconstruction.user->get().model_from_frame.empty())
    text["user_model_from_frame0"] = rows_of(reconstruction.user->get().model_from_frame.front());
  return text.dump(1) + "\n";
}

void write_png(const fs::path& file, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  write_file_atomically(file, std::string(bytes.begin(), bytes.end()));
}

// The closed surface as its points colour it, to pick rims on.
void write_colored_ply(const fs::path& file, const ClosedGarment& garment) {
  PlyExtras extras;
  extras.colors = rough_colors(garment.mesh, garment.support, kColorReach_m);
  write_ply(file, garment.mesh, extras);
}

void write_textured_ply(const fs::path& file, const TexturedMesh& garment, const std::string& texture_file) {
  PlyExtras extras;
  extras.normals = vertex_normals(garment.mesh);
  extras.corner_uv = garment.corner_uv;
  extras.texture_file = texture_file;
  write_ply(file, garment.mesh, extras);
}

}  // namespace

std::vector<std::string> export_reconstruction(const Reconstruction& reconstruction, const fs::path& out) {
  fs::create_directories(out);
  remove_stale_temporaries(out);
  std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> jobs;
  jobs.push_back({"registration.json",
                  [&](const fs::path& file) { write_file_atomically(file, registration_json(reconstruction)); }});
  jobs.push_back({"calibration.json", [&](const fs::path& file) {
                    write_file_atomically(file, calibrated_json(reconstruction.calibrated.get()));
                  }});
  jobs.push_back({"garments.json", [&](const fs::path& file) {
                    write_file_atomically(file, garments_json(reconstruction.opened.get()));
                  }});
  jobs.push_back({"naked_body.ply", [&](const fs::path& file) { write_ply(file, reconstruction.naked.get().body); }});
  for (const auto& each : reconstruction.closed.get().garments) {
    const auto* garment = &each.second;
    jobs.push_back({each.first + "_points.ply", [=](const fs::path& file) { write_ply(file, garment->support); }});
    jobs.push_back({each.first + "_closed.ply", [=](const fs::path& file) { write_colored_ply(file, *garment); }});
  }
  for (const auto& each : reconstruction.textured.get().garments) {
    const auto* slot = &each.first;
    const auto* garment = &each.second;
    jobs.push_back({*slot + ".ply", [=](const fs::path& file) { write_textured_ply(file, *garment, *slot + ".png"); }});
    jobs.push_back({*slot + ".glb", [=](const fs::path& file) { write_glb(file, *garment); }});
    jobs.push_back({*slot + ".png", [=](const fs::path& file) { write_png(file, garment->texture); }});
  }
  if (reconstruction.corrected) {
    jobs.push_back({"user_body.ply", [&](const fs::path& file) { write_ply(file, reconstruction.user->get().body); }});
    for (const auto& each : reconstruction.corrected->get().garments) {
      const auto* slot = &each.first;
      const auto* garment = &each.second;
      jobs.push_back(
          {*slot + "_fitted.ply", [=](const fs::path& file) { write_textured_ply(file, *garment, *slot + ".png"); }});
      jobs.push_back({*slot + "_fitted.glb", [=](const fs::path& file) { write_glb(file, *garment); }});
    }
  }
  if (reconstruction.user) reconstruction.user->get();  // brought into memory by one thread
  reconstruction.registration.get();
  reconstruction.calibrated.get();
  reconstruction.naked.get();
  reconstruction.opened.get();
  std::sort(jobs.begin(), jobs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) { jobs[i].second(out / jobs[i].first); });
  std::vector<std::string> names;
  for (const auto& job : jobs) names.push_back(job.first);
  return names;
}

}  // namespace dressform
