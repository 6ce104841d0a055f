#pragma once
#include <opencv2/core/mat.hpp>

#include "eval/gate/power/fault.h"
#include "scenes/mesh.h"

namespace dressform {

// What faults do to meshes and images. Lengths in metres, images of any type unless said otherwise.

// Every vertex along its normal; inwards where negative.
void blow(Mesh& mesh, double distance_m);
// Every vertex by independent normal numbers of this standard deviation along each axis.
void shake(Mesh& mesh, double sigma_m, const Placement& place);
// All of it.
void shift(Mesh& mesh, const Vector3d& by_m);
// About the centre of its box.
void scale_about_centre(Mesh& mesh, double factor);
void turn_about_centre(Mesh& mesh, double angle_deg, const Vector3d& axis);
// The indices of the triangles whose centroid lies within `radius_m` of a vertex that the placement picks.
std::vector<int> triangles_at_a_spot(const Mesh& mesh, double radius_m, const Placement& place);
// The vertices within `radius_m` of such a vertex, pushed inwards by `depth_m` there, smoothly less around.
void dent(Mesh& mesh, double radius_m, double depth_m, const Placement& place);

// Moved right and down by whole pixels, the border repeated.
void shift_image(cv::Mat& image, int right, int down);
// 8 or 16 bits: every value by a factor, or by levels, held within the type.
void multiply_image(cv::Mat& image, double factor);
void add_levels(cv::Mat& image, double levels);
// A Gaussian of this sigma.
void blur_image(cv::Mat& image, double sigma_px);
// 8-bit masks: grown, or shrunk where negative, by a disc.
void grow_mask(cv::Mat& mask, int pixels);
// A square in the middle half of the image set to one value.
void square_hole(cv::Mat& image, int side_px, const cv::Scalar& value, const Placement& place);

}  // namespace dressform
