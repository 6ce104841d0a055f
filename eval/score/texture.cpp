#include <cmath>

#include "eval/metrics/mesh_distance.h"
#include "eval/score/held_out.h"
#include "eval/score/metric_family.h"

namespace dressform {
namespace {
using namespace metrics;

void judge_texture(const Judged& run, StageRows& rows);

const char *const kWang = "Wang et al., TIP 2004", *const kSharma = "Sharma, Wu, Dalal, CRA 2005";
const MetricFamily texture_metrics{
    "texture",
    "texture",
    {Metric{"<slot>/ssim_observed", 2, "1", Better::higher,
            "SSIM from held-out views without windows whose centre lies on, or nearest to, true cloth that no sensor "
            "saw: nothing tells what is there."}
         .with_target(0.75, 1.0)
         .with_headline("SSIM, held-out views")
         .after(kWang),
     Metric{"<slot>/ssim", 2, "1", Better::higher, "The same over all of the garment."}
         .with_headline("SSIM with unseen cloth")
         .after(kWang),
     Metric{"<slot>/ssim_raw", 2, "1", Better::higher, "The same without the gain."}.after(kWang),
     {"<slot>/psnr_db", 2, "dB", Better::higher, "Where both garments are drawn, after the gain; 100 dB: equal."},
     Metric{"<slot>/de2000_mean", 2, "1", Better::lower, "Mean CIEDE2000 there."}
         .with_headline("CIEDE2000, held-out views")
         .after(kSharma),
     Metric{"<slot>/de2000_p95", 2, "1", Better::lower, "The same, 95th percentile."}.after(kSharma),
     {"<slot>/silhouette_iou", 2, "1", Better::higher, "Of the outlines from there."},
     {"<slot>/gain_red", 2, "1", Better::neither, "The linear gain that was taken out."},
     {"<slot>/gain_green", 2, "1", Better::neither, "The linear gain that was taken out."},
     {"<slot>/gain_blue", 2, "1", Better::neither, "The linear gain that was taken out."}},
    judge_texture};

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

// Absent where nothing can be compared.
std::optional<HeldOutScores> held_out_scores(Renderer& renderer, const Judged& run, const std::string& slot,
                                             const TruthGarment& truth) {
  const GarmentOutput* garment = garment_of(run.outputs, slot);
  if (!run.world_from_model || !garment || garment->textured.mesh.triangles.empty()) return {};
  TexturedMesh estimate = garment->textured;
  estimate.mesh = transformed(estimate.mesh, run.world_from_model->matrix());
  const auto scores = compare_views(
      held_out_views(renderer, estimate, truth.textured, wearer_centre(run.truth), unobserved_triangles(truth)));
  if (scores.pixels == 0) return {};  // nowhere do the two cover the same place
  return scores;
}

void add_scores(StageRows& rows, const std::string& slot, const std::optional<HeldOutScores>& scores,
                const std::string& status_without) {
  const auto add = [&](const std::string& metric, double value) {
    if (scores)
      rows.add(metric, {slot}, value, scores->pixels);
    else
      rows.without_value(metric, {slot}, status_without);
  };
  const HeldOutScores values = scores.value_or(HeldOutScores{});
  add("<slot>/ssim", values.ssim);
  if (scores && std::isnan(scores->ssim_observed))
    rows.absent("<slot>/ssim_observed", {slot});
  else
    add("<slot>/ssim_observed", values.ssim_observed);
  add("<slot>/ssim_raw", values.ssim_raw);
  add("<slot>/psnr_db", values.psnr_db);
  add("<slot>/de2000_mean", values.de2000_mean);
  add("<slot>/de2000_p95", values.de2000_p95);
  add("<slot>/silhouette_iou", values.silhouette_iou);
  add("<slot>/gain_red", values.gain[2]);
  add("<slot>/gain_green", values.gain[1]);
  add("<slot>/gain_blue", values.gain[0]);
}

void judge_texture(const Judged& run, StageRows& rows) {
  if (!run.options.images) return;
  Renderer renderer;
  for (const auto& slot : judged_slots(run)) {
    const auto truth = run.truth.garments.find(slot);
    if (truth == run.truth.garments.end() || truth->second.textured.mesh.triangles.empty())
      add_scores(rows, slot, {}, "absent");
    else
      add_scores(rows, slot, held_out_scores(renderer, run, slot, truth->second), run.status_without_world);
  }
}

}  // namespace
}  // namespace dressform
