#pragma once
#include <vector>

#include "pipeline/alignment/pair_equations.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/registration/view_points.h"

namespace dressform {

// The naked model as a target: its surface, the floor y = 0 and, where asked, the room round it.
class ModelTarget {
 public:
  explicit ModelTarget(const BodyModel& naked);

  struct Contact {
    Vector3d point, normal;  // nearest point of the surface; unit
  };
  // False when nothing is within reach_m.
  bool body(const Vector3d& point, double reach_m, Contact& contact) const {
    return nearest(*query_, point, reach_m, contact);
  }
  bool has_floor() const { return has_floor_; }  // y = 0; else heights mean nothing
  double top_m() const { return top_m_; }        // highest point of the body, model frame
  const MeshQuery& query() const { return *query_; }
  const std::vector<Vector3d>& vertex_normals() const { return normals_; }

 private:
  bool nearest(const MeshQuery& query, const Vector3d& point, double reach_m, Contact& contact) const;
  std::unique_ptr<MeshQuery> query_;
  std::vector<Vector3d> normals_;
  bool has_floor_ = true;
  double top_m_ = 0;
};

struct ModelGate {
  double distance_m = 0.04;  // Tukey's constant
  double normal_cosine = 0.7;
  int most_points = 1 << 30;  // of the body, evenly thinned; of the floor a third of it
};
// Tukey's constant for points of a view's body: the one asked for, or what the view's own noise needs to fit into.
double loss_width_m(const ViewPoints& view, double asked_m);

// How the loss narrows while views are brought to the model: Tukey's constants.
struct LossWidths {
  double wide_m = 0.04, middle_m = 0.015, narrow_m = 0.010;
  double normal_cosine = 0.7;
};

template <class V>
void loss_fields(V& v, LossWidths& p) {
  v("wide_m", p.wide_m, 0.005, 0.5, "m", "width of the loss at first: about what initial poses are off");
  v("middle_m", p.middle_m, 0.002, 0.2, "m", "width of the loss when poses have settled");
  v("narrow_m", p.narrow_m, 0.001, 0.2, "m", "width of the loss at last: about three sigmas of the sensor's noise");
  v("normal_cosine", p.normal_cosine, -1.0, 1.0, "", "least agreement of the normals of a point and the model");
}

// Point to plane of one view against the model; twists in the model frame.
struct ModelEquations {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d vector = Vector6d::Zero();
  double squared_residual_m2 = 0;  // over the body's inliers
  double expected_squared_m2 = 0;  // the same by the sensor's noise and the model's
  double cost = 0;                 // sum of the robust loss over the body's points
  int inliers = 0, points = 0;     // of the body
};
ModelEquations model_equations(const ViewPoints& view, const ModelTarget& target, const Isometry3d& model_from_sensor,
                               const ModelGate& gate);

struct ViewAlignment {
  Isometry3d model_from_sensor = Isometry3d::Identity();
  double cost = 1;                                // mean robust loss of the body's points at the last gate
  double residual_rms_m = 0, expected_rms_m = 0;  // expected: by noise alone
  int inliers = 0;
  double inlier_part = 0;  // of the body's points
  bool valid = false;
};
// Takes over what the equations say of how well the view fits.
void measure(const ModelEquations& equations, ViewAlignment& alignment);

ViewAlignment align_to_model(const ViewPoints& view, const ModelTarget& target, const Isometry3d& initial,
                             const std::vector<ModelGate>& gates, int iterations);

// Part of the model's surface facing the sensor at which the sensor looked through the model, seeing something more
// than tolerance_m behind it: evidence against a pose. Hidden and unmeasured parts do not count.
double contradicted_part(const ViewPoints& view, const ModelTarget& target, const Projector& projector,
                         const Isometry3d& model_from_sensor, double tolerance_m);

}  // namespace dressform
