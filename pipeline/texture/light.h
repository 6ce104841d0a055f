#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "pipeline/fuse/fuse.h"
#include "pipeline/registration/registration.h"
#include "scenes/capture_session.h"

namespace dressform {

// How the room lights the wearer: irradiance by the direction a surface faces and by its height, per channel (BGR), up
// to one factor a channel. Its logarithm is a polynomial of second order in the normal, as irradiance nearly is
// (Ramamoorthi and Hanrahan, SIGGRAPH 2001), whose constant and linear parts change with the height.
class Light {
 public:
  static constexpr int kTerms = 14;
  using Coefficients = Eigen::Matrix<double, kTerms, 3>;
  explicit Light(const Coefficients& coefficients) : coefficients_(coefficients) {}

  // Log of irradiance on a surface at `point` (model frame, metres) with a unit normal.
  Eigen::RowVector3d log_irradiance(const Vector3d& point, const Vector3d& normal) const;

 private:
  Coefficients coefficients_;
};

// The light as it falls on the naked body, which is taken to be of one matt colour: the whole of it is a light probe.
// Robust least squares (iteratively reweighted, Cauchy) over the views' colours in linear light, with one factor for
// each sensor and channel. Nothing where there are fewer than a thousand readings or where the light explains less than
// half of their variance: then the body is not of one colour, or its light is more broken than this.
std::optional<Light> light_on(const BodyModel& naked, const std::map<std::string, Shot>& shots,
                              const Calibration& calibration, const Registration& registration);

// Factors (vertices x 3, BGR, linear light) that take the light off a surface, their log averaging 0 over its
// vertices. `part`: of the light's log that is taken off, 0 to 1.
Eigen::MatrixXf unlit_gains(const Light& light, const Mesh& mesh, double part);

}  // namespace dressform
