#include "pipeline/correct/push_out.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dressform {
namespace {

constexpr double kLargestLift_m = 0.012;  // of a cut triangle in one round
// Leaving the way the cloth faces may be so much longer than leaving by the nearest side, and so much more.
constexpr double kDetour = 4, kDetour_m = 0.02;
constexpr int kRelaxedRings = 2;
constexpr double kReached = 0.98;                    // of the gap
constexpr double kDeep_m = 0.004, kTurnsOver = 0.3;  // inside, and the nearest way out so much against the cloth's side
constexpr double kContradict = 0.4;                  // length of the mean normal of what cuts a triangle
constexpr double kEdgeOn = 0.2, kEdgeOnLift_m = 0.002;  // cosine to the triangle's normal, and the step then
constexpr double kOver = 0.3;                           // of the gap, beyond what cuts
constexpr double kFade = 0.9;                           // of a push from one ring of neighbours to the next
constexpr double kShrinkRounds = 20, kLeastGap = 0.1;
constexpr int kPatience = 15;  // rounds after which the gap shrinks: the room between arm and trunk may be less

std::vector<std::vector<int>> neighbours_of(const Mesh& mesh) {
  std::vector<std::vector<int>> neighbours(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      neighbours[t[k]].push_back(t[(k + 2) % 3]);
    }
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

// Per vertex, whether it lies on a side that one triangle alone has.
std::vector<char> rim_vertices(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> triangles_of;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++triangles_of[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<char> rim(mesh.vertices.size(), 0);
  for (const auto& [side, count] : triangles_of)
    if (count == 1) rim[side.first] = rim[side.second] = 1;
  return rim;
}

class Pusher {
 public:
  Pusher(const Mesh& garment, const MeshQuery& body, const IntersectionFinder& finder, const std::vector<char>& beside,
         const PushOutParams& params)
      : mesh_(garment),
        body_(body),
        finder_(finder),
        beside_(beside),
        params_(params),
        neighbours_(neighbours_of(garment)),
        on_rim_(rim_vertices(garment)),
        stale_vertex_(garment.vertices.size(), 1),
        cuts_(garment.triangles.size()) {}

  PushedOut run() {
    PushedOut result;
    std::vector<char> stale_triangle(mesh_.triangles.size(), 1);
    for (result.rounds = 0; result.rounds < params_.rounds; ++result.rounds) {
      gap_m_ = params_.gap_m * std::clamp(1 - (result.rounds - kPatience) / kShrinkRounds, kLeastGap, 1.0);
      std::vector<Vector3d> push(mesh_.vertices.size(), Vector3d::Zero());
      bool any = find_vertex_pushes(push);
      if (!any) {
        find_cuts(stale_triangle);
        any = find_triangle_lifts(push);
      }
      if (!any) break;
      if (result.rounds >= kPatience) relax(push);
      diffuse(push, result.rounds == 0 ? params_.diffusion_rounds : std::min(3, params_.diffusion_rounds));
      apply(push, stale_triangle);
    }
    std::fill(stale_triangle.begin(), stale_triangle.end(), 1);
    find_cuts(stale_triangle);
    for (const auto& cuts : cuts_) result.intersecting_pairs += static_cast<int>(cuts.size());
    result.vertices = mesh_.vertices;
    return result;
  }

 private:
  // Where cloth at `v` should go to be out of the body; its own place if it is.
  Vector3d exit_of(std::size_t v, const Vector3d& cloth_normal) const {
    const Vector3d& p = mesh_.vertices[v];
    const auto closest = body_.closest(p);
    const double distance = body_.signed_distance(p, closest);
    if (distance >= kReached * gap_m_) return p;
    Vector3d out = distance < 0 ? Vector3d(closest.point - p) : Vector3d(p - closest.point);
    out = std::abs(distance) > 1e-5 ? Vector3d(out.normalized()) : body_.normal(closest.triangle);
    const Vector3d facing = beside_[closest.triangle] ? Vector3d(-cloth_normal) : cloth_normal;
    if (distance < -kDeep_m && out.dot(facing) < -kTurnsOver) {
      const auto hit = body_.first_hit(p, facing);
      if (hit && hit->distance < kDetour * -distance + kDetour_m && body_.normal(hit->triangle).dot(facing) > 0)
        return hit->point + gap_m_ * body_.normal(hit->triangle);
    }
    return closest.point + gap_m_ * out;
  }

  bool find_vertex_pushes(std::vector<Vector3d>& push) {
    const auto normals = vertex_normals(mesh_);
    tbb::parallel_for(std::size_t{0}, push.size(), [&](std::size_t v) {
      if (stale_vertex_[v]) push[v] = exit_of(v, normals[v]) - mesh_.vertices[v];
    });
    return std::any_of(push.begin(), push.end(), [](const Vector3d& p) { return p.squaredNorm() > 0; });
  }

  void find_cuts(std::vector<char>& stale_triangle) {
    tbb::parallel_for(std::size_t{0}, cuts_.size(), [&](std::size_t i) {
      if (!stale_triangle[i]) return;
      const Vector3i& t = mesh_.triangles[i];
      cuts_[i] = finder_.cut_by(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
    });
    std::fill(stale_triangle.begin(), stale_triangle.end(), 0);
  }

  // The step that lifts triangle `i` over the body's triangles that cut it.
  Vector3d lift_of(std::size_t i) const {
    const Vector3i& t = mesh_.triangles[i];
    const Vector3d& a = mesh_.vertices[t[0]];
    Vector3d normal = (mesh_.vertices[t[1]] - a).cross(mesh_.vertices[t[2]] - a);
    Vector3d out = Vector3d::Zero();
    bool beside = false;
    for (int other : cuts_[i]) {
      out += body_.normal(other) / static_cast<double>(cuts_[i].size());
      beside = beside || beside_[other];
    }
    normal = normal.norm() > 0 ? Vector3d(normal.normalized()) : out.normalized();
    if (out.norm() < kContradict) out = beside ? Vector3d(-normal) : normal;
    out.normalize();
    if (normal.dot(out) < 0) normal = -normal;
    if (normal.dot(out) < kEdgeOn) return kEdgeOnLift_m * out;
    double height = 0;
    for (int other : cuts_[i])
      for (int k = 0; k < 3; ++k)
        height = std::max(height, normal.dot(body_.mesh().vertices[body_.mesh().triangles[other][k]] - a));
    return std::min(kLargestLift_m, (height + kOver * gap_m_) / normal.dot(out)) * out;
  }

  bool find_triangle_lifts(std::vector<Vector3d>& push) const {
    bool any = false;
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      if (cuts_[i].empty()) continue;
      any = true;
      const Vector3d lift = lift_of(i);
      for (int k = 0; k < 3; ++k) {
        Vector3d& own = push[mesh_.triangles[i][k]];
        if (lift.squaredNorm() > own.squaredNorm()) own = lift;
      }
    }
    return any;
  }

  // Cloth that is still cut after so many rounds is crumpled into a place too narrow for it, and lifting its triangles
  // one by one only draws them out. It is smoothed first: what is pushed, and the rings about it, goes to the middle of
  // its neighbours, on rims to the middle of those on the rim.
  void relax(std::vector<Vector3d>& push) const {
    std::vector<char> pushed(push.size());
    for (std::size_t v = 0; v < push.size(); ++v) pushed[v] = push[v].squaredNorm() > 0;
    for (int ring = 0; ring < kRelaxedRings; ++ring) {
      const std::vector<char> before = pushed;
      for (std::size_t v = 0; v < push.size(); ++v)
        for (int n : neighbours_[v]) pushed[v] = pushed[v] || before[n];
    }
    for (std::size_t v = 0; v < push.size(); ++v) {
      if (!pushed[v]) continue;
      Vector3d sum = Vector3d::Zero();
      int count = 0;
      for (int n : neighbours_[v])
        if (!on_rim_[v] || on_rim_[n]) sum += mesh_.vertices[n], ++count;
      if (count > 0) push[v] += 0.5 * (sum / count - mesh_.vertices[v]);
    }
  }

  // Pushed vertices keep their push; the others take a fading part of their neighbours'.
  void diffuse(std::vector<Vector3d>& push, int rounds) const {
    std::vector<char> fixed(push.size());
    for (std::size_t v = 0; v < push.size(); ++v) fixed[v] = push[v].squaredNorm() > 0;
    for (int round = 0; round < rounds; ++round) {
      const std::vector<Vector3d> before = push;
      tbb::parallel_for(std::size_t{0}, push.size(), [&](std::size_t v) {
        if (fixed[v] || neighbours_[v].empty()) return;
        Vector3d mean = Vector3d::Zero();
        for (int n : neighbours_[v]) mean += before[n];
        push[v] = kFade * mean / static_cast<double>(neighbours_[v].size());
        if (push[v].squaredNorm() < 1e-12) push[v].setZero();
      });
    }
  }

  void apply(const std::vector<Vector3d>& push, std::vector<char>& stale_triangle) {
    for (std::size_t v = 0; v < push.size(); ++v) {
      stale_vertex_[v] = push[v].squaredNorm() > 0;
      mesh_.vertices[v] += push[v];
    }
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (stale_vertex_[mesh_.triangles[i][k]]) stale_triangle[i] = 1;
  }

  Mesh mesh_;
  const MeshQuery& body_;
  const IntersectionFinder& finder_;
  const std::vector<char>& beside_;
  const PushOutParams params_;
  double gap_m_ = params_.gap_m;
  const std::vector<std::vector<int>> neighbours_;
  const std::vector<char> on_rim_;
  std::vector<char> stale_vertex_;      // moved since its distance was last found
  std::vector<std::vector<int>> cuts_;  // per triangle, as last found
};

}  // namespace

PushedOut push_out(const Mesh& garment, const MeshQuery& body, const IntersectionFinder& finder,
                   const std::vector<char>& beside, const PushOutParams& params) {
  return Pusher(garment, body, finder, beside, params).run();
}

}  // namespace dressform
