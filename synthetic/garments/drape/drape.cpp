#include "synthetic/garments/drape/drape.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "scenes/random.h"
#include "synthetic/garments/drape/springs.h"

namespace dressform {
namespace {

constexpr double kBodyReach = 0.015;  // how far from a vertex the body is looked for, m
constexpr double kRoomUsed = 0.45;    // of a vertex's room; below a half
// Of springs and hinges against their own motion, in parts of what moves them: one sweep a step does not satisfy all of
// them, and what is left over must not come back as motion.
constexpr double kDamping = 0.6;
constexpr int kMostSteps = 100;  // between two searches

struct BodyContact {
  int vertex;
  Vector3d point, normal;
};

struct LayerContact {
  NearPair pair;
  double keep_m;  // apart
};

class Drape {
 public:
  Drape(const Cloth& cloth, const Wearer& wearer, const DrapeParams& params, Seed seed)
      : cloth_(cloth), wearer_(wearer), params_(params), moving_(static_cast<int>(cloth.mesh.vertices.size())) {
    x_ = cloth.mesh.vertices;
    join_layer();
    lightness_ = lightness_of(cloth);
    springs_ = springs_of(cloth, params, lightness_);
    hinges_ = hinges_of(cloth, params);
    lightness_.resize(x_.size(), 0);
    for (double rest : cloth_.rest_m) mean_edge_m_ += rest / static_cast<double>(cloth_.rest_m.size());
    rest_place_ = x_;
    search();
    ruffle(seed);
    stay_in_room();
  }

  DrapeResult run() {
    DrapeResult result;
    const int steps = std::max(1, static_cast<int>(std::lround(params_.seconds / params_.step_s)));
    velocity_.assign(moving_, Vector3d::Zero());
    before_ = x_;
    const int late = steps - std::max(1, steps / 10);
    std::vector<Vector3d> late_place = x_;
    int since_search = kMostSteps;
    for (int step = 0; step < steps; ++step) {
      if (since_search >= kMostSteps) {
        search();
        ++result.searches;
        since_search = 0;
      }
      if (step == late) late_place = x_;
      since_search = advance(step, steps) ? since_search + 1 : kMostSteps;
    }
    result.steps = steps;
    result.vertices.assign(x_.begin(), x_.begin() + moving_);
    result.strain_p95 = strain_quantile(cloth_, result.vertices, 0.95);
    for (int i = 0; i < moving_; ++i)
      result.speed_m_per_s += (x_[i] - late_place[i]).norm() / (moving_ * (steps - late) * params_.step_s);
    result.converged = result.speed_m_per_s < params_.settled_m_per_s;
    return result;
  }

 private:
  void join_layer() {
    features_ = cloth_.features;
    for (const Vector3d& v : wearer_.layer.vertices) x_.push_back(v);
    const Features layer = features_of(wearer_.layer.triangles);
    for (const auto& e : layer.edges) features_.edges.emplace_back(e[0] + moving_, e[1] + moving_);
    for (const Vector3i& t : layer.triangles) features_.triangles.push_back(t + Vector3i::Constant(moving_));
  }

  // A smooth unevenness along the normals.
  void ruffle(Seed seed) {
    const std::vector<Vector3d> normals = vertex_normals(cloth_.mesh);
    const std::uint64_t stream = stream_of("ruffle");
    for (int i = 0; i < moving_; ++i) {
      if (lightness_[i] == 0) continue;
      double sum = 0;
      for (int k = 0; k < 12; ++k) {
        const auto n = normal4(seed, stream, k);
        sum += std::sin(75 * Vector3d(n[0], 0.4 * n[1], n[2]).dot(x_[i]) + 7 * n[3]) / 3.5;
      }
      const double room = std::min(1.0, wearer_.clearance_m[i] / 0.004);
      x_[i] += room * params_.ruffle_m * sum * normals[i];
    }
  }

  void search() {
    std::vector<std::optional<BodyContact>> found(moving_);
    if (wearer_.body)
      tbb::parallel_for(0, moving_, [&](int i) {
        if (lightness_[i] == 0) return;
        const auto near = wearer_.body->closest(x_[i], kBodyReach);
        if (near.found) found[i] = BodyContact{i, near.point, near.normal};
      });
    on_body_.clear();
    for (const auto& contact : found)
      if (contact) on_body_.push_back(*contact);
    NearResult near = near_pairs(x_, features_, moving_, reach());
    layers_.clear();
    for (const NearPair& pair : near.pairs) layers_.push_back({pair, distance_to_keep(pair)});
    room_ = std::move(near.room_m);
    searched_at_ = x_;
  }

  // More than that and every feature is near to its neighbours.
  double reach() const { return std::min(2 * params_.thickness_m, 0.55 * mean_edge_m_); }

  // The cloth's thickness, but no more than most of what was between the same two places at the start.
  double distance_to_keep(const NearPair& pair) const {
    Vector3d gap = Vector3d::Zero();
    for (int k = 0; k < 4; ++k) gap += pair.weight[k] * rest_place_[pair.vertex[k]];
    return std::min(params_.thickness_m, 0.6 * gap.norm());
  }

  // One substep; false where cloth has used up its room.
  bool advance(int step, int steps) {
    const double dt = params_.step_s, done = static_cast<double>(step) / steps;
    const double grown = params_.grow_part > 0 ? std::min(1.0, done / params_.grow_part) : 1.0;
    const double drag = params_.drag_per_s + 30 * std::max(0.0, done - 0.6);  // 1/s
    for (int i = 0; i < moving_; ++i) {
      if (lightness_[i] == 0) continue;
      before_[i] = x_[i];
      velocity_[i] *= 1 - drag * dt;
      velocity_[i].y() -= kGravity * dt;
      x_[i] += dt * velocity_[i];
    }
    const bool down = step % 2 == 0;
    for (size_t n = 0; n < springs_.size(); ++n) stretch(springs_[down ? n : springs_.size() - 1 - n], grown);
    for (const Hinge& hinge : hinges_) bend(hinge);
    for (const LayerContact& contact : layers_) keep_apart(contact);
    for (const BodyContact& contact : on_body_) keep_off(contact);
    for (int i = 0; i < moving_; ++i)
      if (x_[i].y() < wearer_.floor_y_m + wearer_.clearance_m[i])
        keep_off({i, Vector3d(x_[i].x(), wearer_.floor_y_m, x_[i].z()), Vector3d::UnitY()});
    const bool room_left = stay_in_room();
    for (int i = 0; i < moving_; ++i)
      if (lightness_[i] > 0) velocity_[i] = (x_[i] - before_[i]) / dt;
    return room_left;
  }

  void stretch(const Spring& spring, double grown) {
    const double wa = lightness_[spring.a], wb = lightness_[spring.b];
    const Vector3d between = x_[spring.a] - x_[spring.b];
    const double length = between.norm(), rest = spring.first + grown * (spring.rest - spring.first);
    const double softness = spring.compliance / (params_.step_s * params_.step_s);
    if (length < 1e-12) return;
    const double change = between.dot(between - before_[spring.a] + before_[spring.b]) / length;
    const double push_m = (rest - length - kDamping * change) / ((1 + kDamping) * (wa + wb) + softness);
    const Vector3d push = push_m / length * between;
    x_[spring.a] += wa * push;
    x_[spring.b] -= wb * push;
  }

  void bend(const Hinge& hinge) {
    Vector3d sum = Vector3d::Zero();
    double weight = hinge.compliance / (params_.step_s * params_.step_s);
    for (int k = 0; k < 4; ++k) {
      const int i = hinge.vertex[k];
      sum += hinge.weight[k] * (x_[i] + kDamping * (x_[i] - before_[i]));
      weight += (1 + kDamping) * lightness_[i] * hinge.weight[k] * hinge.weight[k];
    }
    sum /= -weight;
    for (int k = 0; k < 4; ++k) x_[hinge.vertex[k]] += lightness_[hinge.vertex[k]] * hinge.weight[k] * sum;
  }

  void keep_apart(const LayerContact& contact) {
    const NearPair& pair = contact.pair;
    Vector3d gap = Vector3d::Zero(), slip = Vector3d::Zero();
    double weight = 0;
    for (int k = 0; k < 4; ++k) {
      const int i = pair.vertex[k];
      gap += pair.weight[k] * x_[i];
      weight += lightness_[i] * pair.weight[k] * pair.weight[k];
      if (lightness_[i] > 0) slip += pair.weight[k] * (x_[i] - before_[i]);
    }
    const double missing = contact.keep_m - gap.dot(pair.normal);
    if (missing <= 0 || weight == 0) return;
    // A tenth of what is missing at a time: cloth is no billiard ball.
    Vector3d push = 0.2 * missing * pair.normal;
    slip -= slip.dot(pair.normal) * pair.normal;
    const double length = slip.norm();
    if (length > 1e-12) push -= std::min(1.0, params_.friction * push.norm() / length) * slip;
    for (int k = 0; k < 4; ++k) x_[pair.vertex[k]] += lightness_[pair.vertex[k]] * pair.weight[k] / weight * push;
  }

  void keep_off(const BodyContact& contact) {
    const int i = contact.vertex;
    const double missing = wearer_.clearance_m[i] - (x_[i] - contact.point).dot(contact.normal);
    if (missing <= 0) return;
    x_[i] += missing * contact.normal;
    Vector3d slip = x_[i] - before_[i];
    slip -= slip.dot(contact.normal) * contact.normal;
    const double length = slip.norm();
    if (length > 1e-12) x_[i] -= std::min(1.0, params_.friction * missing / length) * slip;
  }

  bool stay_in_room() {
    int stopped = 0;
    for (int i = 0; i < moving_; ++i) {
      const Vector3d moved = x_[i] - searched_at_[i];
      const double most = kRoomUsed * room_[i], length = moved.norm();
      if (length <= most) continue;
      x_[i] = searched_at_[i] + most / length * moved;
      ++stopped;
    }
    return 50 * stopped < moving_;
  }

  const Cloth& cloth_;
  const Wearer& wearer_;
  const DrapeParams& params_;
  const int moving_;  // vertices of the cloth; those of the layer come behind them
  Features features_;
  std::vector<Vector3d> x_, before_, velocity_, searched_at_, rest_place_;
  std::vector<double> lightness_, room_;
  double mean_edge_m_ = 0;
  std::vector<Spring> springs_;
  std::vector<Hinge> hinges_;
  std::vector<BodyContact> on_body_;
  std::vector<LayerContact> layers_;
};

}  // namespace

DrapeResult drape(const Cloth& cloth, const Wearer& wearer, const DrapeParams& params, Seed seed) {
  return Drape(cloth, wearer, params, seed).run();
}

}  // namespace dressform
