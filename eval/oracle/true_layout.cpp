#include "eval/oracle/true_layout.h"

#include <algorithm>

#include "eval/oracle/oracle_frames.h"
#include "pipeline/garment/garment_ends.h"
#include "pipeline/garment/garment_kind.h"
#include "pipeline/garment/worn_order.h"
#include "scenes/error.h"

namespace dressform {
namespace {

bool has_ankle(const std::vector<TruthRim>& rims) {
  return std::any_of(rims.begin(), rims.end(),
                     [](const TruthRim& rim) { return rim.name.find("ankle") != std::string::npos; });
}

std::string true_kind(const OracleInput& input, const std::string& slot, const std::vector<Vector3d>& points) {
  const auto& landmarks = input.made.landmarks.get();
  const auto rims = input.truth.rims.find(slot);
  if (slot == "bottom")
    return rims == input.truth.rims.end() ? bottom_kind(points, landmarks).kind
           : has_ankle(rims->second)      ? "trousers"
                                          : "skirt";
  return input.truth.garments.count("bottom") ? "shirt" : top_kind(points, landmarks).kind;
}

PointCloud cloud_of(const Mesh& mesh) {
  PointCloud cloud;
  cloud.points = mesh.vertices;
  cloud.normals = vertex_normals(mesh);
  return cloud;
}

}  // namespace

Mesh garment_in_model(const OracleInput& input, const std::string& slot) {
  const auto found = input.truth.garments.find(slot);
  if (found == input.truth.garments.end() || found->second.mesh.triangles.empty())
    throw InputError("truth", "has no mesh of the garment " + slot + "; expected it");
  return transformed(compacted(found->second.mesh), model_from_world_by_gauge(input).matrix());
}

GarmentLayouts true_layouts(const OracleInput& input, bool order) {
  GarmentLayouts layouts;
  if (input.truth.garments.empty()) throw InputError("truth", "has no garments; expected them");
  const MeshQuery naked(input.made.naked.get().body);
  const Landmarks& landmarks = input.made.landmarks.get();
  std::map<std::string, PointCloud> clouds;
  for (const auto& [slot, garment] : input.truth.garments) {
    clouds[slot] = cloud_of(garment_in_model(input, slot));
    GarmentLayout layout;
    layout.kind = true_kind(input, slot, clouds[slot].points);
    layout.sure_kind = 1;
    layouts[slot] = with_ends(layout, clouds[slot].points, naked, landmarks);
  }
  if (!order || layouts.size() < 2) return layouts;
  const WornOrder worn = worn_order(clouds["top"], clouds["bottom"], naked, landmarks);
  if (worn.top == Worn::alone) return layouts;
  layouts["top"].worn = worn.top;
  layouts["bottom"].worn = worn.top == Worn::under ? Worn::over : Worn::under;
  layouts["top"].sure_worn = layouts["bottom"].sure_worn = 1;
  return layouts;
}

}  // namespace dressform
