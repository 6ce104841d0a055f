#include "eval/score/mesh_pair.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "eval/score/mesh_bounds.h"
#include "eval/score/metric_family.h"
#include "eval/score/rigid_fit.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const std::string kSlot = "mesh";
const std::set<std::string> kStages{"surface", "open", "texture"};  // that ask for one mesh and its truth alone

// The mesh with its texture where the file has one; without triangles else.
TexturedMesh textured_if_it_is(const fs::path& file) {
  TexturedMesh mesh = read_mesh_as_it_looks(file);
  return mesh.texture.empty() ? TexturedMesh{} : mesh;
}

// Boundary loops as rims that are wholly seen; absent where the mesh has no proper boundary.
std::optional<std::vector<TruthRim>> rims_of(const Mesh& mesh) {
  std::vector<TruthRim> rims;
  try {
    for (const auto& loop : boundary_loops(mesh)) {
      rims.push_back({std::to_string(rims.size() + 1), 1, {}});
      for (const int vertex : loop) rims.back().points.push_back(mesh.vertices[vertex]);
    }
  } catch (const std::invalid_argument&) {
    return {};
  }
  return rims;
}

GroundTruth read_truth(const fs::path& file) {
  GroundTruth truth;
  TruthGarment& garment = truth.garments[kSlot];
  garment.mesh = read_mesh(file);
  check_mesh_bounds(garment.mesh, file.string());
  garment.textured = textured_if_it_is(file);
  if (file.extension() == ".ply") garment.views = find_ply_vertex_property(file, "views").value_or(garment.views);
  if (!garment.views.empty() && garment.views.size() != garment.mesh.vertices.size())
    throw InputError(file.string() + ": views",
                     fmt::format("found {} values; expected {}", garment.views.size(), garment.mesh.vertices.size()));
  if (const auto rims = rims_of(garment.mesh)) truth.rims[kSlot] = *rims;
  return truth;
}

RunOutputs read_estimate(const fs::path& file, const MeshFrame& frame) {
  RunOutputs outputs;
  GarmentOutput& garment = outputs.garments[kSlot];
  garment.mesh = in_world(read_mesh(file), frame);
  check_mesh_bounds(garment.mesh, file.string());
  garment.textured = textured_if_it_is(file);
  garment.textured.mesh = in_world(garment.textured.mesh, frame);
  return outputs;
}

}  // namespace

MeshPairScores score_mesh_pair(const fs::path& estimate, const fs::path& truth_file, MeshAlignment alignment,
                               const MeshFrame& frame) {
  const RunOutputs outputs = read_estimate(estimate, frame);
  const GroundTruth truth = read_truth(truth_file);
  MeshPairScores result;
  if (alignment == MeshAlignment::gauge)
    result.truth_from_estimate = best_rigid_motion(outputs.garments.at(kSlot).mesh, truth.garments.at(kSlot).mesh);
  const Judged run{outputs, truth, result.truth_from_estimate, "absent", {}, {}};
  result.scores.scene = truth_file.filename().string();
  result.scores.variant =
      estimate.filename().string() + (alignment == MeshAlignment::gauge ? " align=gauge" : " align=none");
  for (const auto* family : metric_families()) {
    if (!kStages.count(family->stage())) continue;
    const auto rows = family->judge(run);
    result.scores.rows.insert(result.scores.rows.end(), rows.begin(), rows.end());
  }
  return result;
}

}  // namespace dressform
