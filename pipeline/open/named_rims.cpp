#include "pipeline/open/named_rims.h"

#include <algorithm>
#include <limits>

namespace dressform {

std::vector<Rim> named_rims(const Mesh& mesh, const CutResult& cut, const std::vector<Opening>& openings,
                            const std::vector<bool>& observed, const std::vector<RimCurve>& curves) {
  std::vector<Vector3d> centres(openings.size(), Vector3d::Zero());
  std::vector<int> counts(openings.size(), 0);
  for (std::size_t i = 0; i < cut.mesh.vertices.size(); ++i) {
    if (cut.cap_of_vertex[i] < 0) continue;
    centres[cut.cap_of_vertex[i]] += cut.mesh.vertices[i];
    ++counts[cut.cap_of_vertex[i]];
  }
  std::vector<Rim> rims;
  for (const auto& loop : boundary_loops(mesh)) {
    Vector3d centre = Vector3d::Zero();
    for (const int v : loop) centre += mesh.vertices[v] / loop.size();
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < openings.size(); ++k) {
      const double distance = (centres[k] / std::max(1, counts[k]) - centre).norm();
      if (distance < nearest) best = k;
      nearest = std::min(nearest, distance);
    }
    Rim rim{openings[best].name, {}, observed[best], {}};
    for (const int v : loop) {
      rim.points.push_back(mesh.vertices[v]);
      if (!curves.empty())
        rim.hidden.push_back(!rim.observed || curves[best].unseen(openings[best].angle(mesh.vertices[v])));
    }
    rims.push_back(std::move(rim));
  }
  return rims;
}

}  // namespace dressform
