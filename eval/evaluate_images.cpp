#include <cmath>

#include "eval/evaluate_parts.h"
#include "eval/held_out.h"
#include "eval/metrics/label_metrics.h"
#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/sampling.h"

namespace dressform::evaluation {
using namespace metrics;

namespace {

struct LabelName {
  const char* name;
  std::uint8_t label;
};
constexpr LabelName kLabels[] = {{"skin", 1}, {"top", 2}, {"bottom", 3}};

void add_mean(StageRows& rows, const std::string& metric, const std::vector<double>& values, std::size_t expected) {
  if (values.size() == expected && expected > 0)
    rows.add(metric, "1", mean(values), static_cast<long>(values.size()));
  else
    rows.fail(metric, "1");
}

}  // namespace

std::vector<ScoreRow> labels(const RunOutputs& outputs, const GroundTruth& truth) {
  StageRows rows("segment");
  std::vector<std::pair<const cv::Mat*, const cv::Mat*>> pairs;  // estimate, truth
  for (const auto& [sensor, label] : truth.labels) {
    const auto found = outputs.labels.find(sensor);
    const bool usable = found != outputs.labels.end() && found->second.size() == label.size();
    for (const auto& name : kLabels) {
      const std::string metric = sensor + "/iou_" + name.name + "@1";
      if (usable)
        rows.add(metric, "1", label_iou(found->second, label, name.label), static_cast<long>(label.total()));
      else
        rows.fail(metric, "1");
    }
    if (usable) pairs.push_back({&found->second, &label});
  }
  for (const auto& name : kLabels) {
    std::vector<double> overlap, outline;
    for (const auto& [estimate, label] : pairs) {
      overlap.push_back(label_iou(*estimate, *label, name.label));
      outline.push_back(boundary_f(*estimate, *label, name.label));
    }
    add_mean(rows, std::string("mean/iou_") + name.name + "@1", overlap, truth.labels.size());
    add_mean(rows, std::string("mean/boundary_f_") + name.name + "@1", outline, truth.labels.size());
  }
  std::vector<double> leakage, miss;
  for (const auto& [estimate, label] : pairs) {
    leakage.push_back(foreground_leakage(*estimate, *label));
    miss.push_back(foreground_miss(*estimate, *label));
  }
  add_mean(rows, "mean/foreground_leakage@1", leakage, truth.labels.size());
  add_mean(rows, "mean/foreground_miss@1", miss, truth.labels.size());
  return rows.rows;
}

namespace {

// Of each triangle of the textured garment, whether no sensor saw its middle.
std::vector<bool> unobserved_triangles(const TruthGarment& garment) {
  const Mesh& textured = garment.textured.mesh;
  std::vector<bool> result(textured.triangles.size(), false);
  if (garment.views.empty()) return result;
  std::vector<Vector3d> middles;
  for (const auto& t : textured.triangles)
    middles.push_back((textured.vertices[t[0]] + textured.vertices[t[1]] + textured.vertices[t[2]]) / 3);
  const auto nearest = MeshDistance(garment.mesh).nearest(middles);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const Vector3i& t = garment.mesh.triangles[nearest[i].triangle];
    result[i] = !(garment.views[t[0]] && garment.views[t[1]] && garment.views[t[2]]);
  }
  return result;
}

// Of the wearer; without one, of what is worn.
Vector3d wearer_centre(const GroundTruth& truth) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : truth.naked_body.vertices) box.extend(v);
  if (box.isEmpty())
    for (const auto& [slot, garment] : truth.garments)
      for (const Vector3d& v : garment.mesh.vertices) box.extend(v);
  return box.center();
}

}  // namespace

std::vector<ScoreRow> textures(const RunOutputs& outputs, const GroundTruth& truth,
                               const std::optional<Isometry3d>& world_from_model) {
  StageRows rows("texture");
  Renderer renderer;
  for (const auto& [slot, garment] : truth.garments) {
    std::optional<HeldOutScores> scores;
    const auto found = outputs.garments.find(slot);
    if (world_from_model && found != outputs.garments.end() && !found->second.textured.mesh.triangles.empty()) {
      TexturedMesh estimate = found->second.textured;
      estimate.mesh = transformed(estimate.mesh, world_from_model->matrix());
      scores = compare_views(
          held_out_views(renderer, estimate, garment.textured, wearer_centre(truth), unobserved_triangles(garment)));
      if (scores->pixels == 0) scores.reset();  // nowhere do the two cover the same place
    }
    const auto add = [&, slot = slot](const char* name, const char* unit, double value) {
      if (scores)
        rows.add(slot + "/" + name, unit, value, scores->pixels);
      else
        rows.fail(slot + "/" + name, unit);
    };
    const HeldOutScores found_scores = scores.value_or(HeldOutScores{});
    add("ssim@2", "1", found_scores.ssim);
    if (scores && std::isnan(scores->ssim_observed))
      rows.absent(slot + "/ssim_observed@2", "1");
    else
      add("ssim_observed@2", "1", found_scores.ssim_observed);
    add("ssim_raw@2", "1", found_scores.ssim_raw);
    add("psnr_db@2", "dB", found_scores.psnr_db);
    add("de2000_mean@2", "1", found_scores.de2000_mean);
    add("de2000_p95@2", "1", found_scores.de2000_p95);
    add("silhouette_iou@2", "1", found_scores.silhouette_iou);
    add("gain_red@2", "1", found_scores.gain[2]);
    add("gain_green@2", "1", found_scores.gain[1]);
    add("gain_blue@2", "1", found_scores.gain[0]);
  }
  return rows.rows;
}

}  // namespace dressform::evaluation
