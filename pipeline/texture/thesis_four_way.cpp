// The thesis's texture (section 3.5): exposures evened out between the photographs, all of them in one map side by
// side, the mesh cut in parts along borders that a person picked between the views, and each part projected into its
// own photograph (equations 3.1 to 3.6 the other way round), with no test of visibility: what is hidden there takes the
// colour of what hides it, and lies on it in the map. The thesis balanced exposure by hand; gains from what the views
// share stand in.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/texture/garment_views.h"
#include "pipeline/texture/picked_parts.h"
#include "scenes/error.h"
#include "scenes/picks.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

constexpr int kMargin_px = 4;      // between photographs, in their own colour, for the coarser levels of a mipmap
constexpr int kNoTexture_px = 16;  // width of the grey that a garment without any view gets
const cv::Scalar kGrey(128, 128, 128);

struct ThesisFourWayParams {
  ViewParams view = projected_blindly();
  GainParams gain;
  PickedPartsParams parts;
  int largest_px = 4096;
};
template <class V>
void fields(V& v, ThesisFourWayParams& p) {
  v("erode_m", p.view.erode_m, 0.0, 0.05, "m", "taken off the garment's outline, at least a pixel");
  v("gain_least_facing", p.gain.least_facing, 0.05, 0.95, "",
    "least cosine of the viewing angle where views are compared");
  v("gain_least_vertices", p.gain.least_vertices, 1, 100000, "", "vertices two views must share to be compared");
  v("narrowest", p.parts.narrowest, 0.3, 10.0, "", "mean edges from a border within which its strip lies at first");
  v("widest_m", p.parts.widest_m, 0.001, 0.1, "m", "the same at most, where more parts come apart");
  v("to_rim_m", p.parts.to_rim_m, 0.0, 0.3, "m", "borders that end this near to a rim go on to it");
  v("least_part", p.parts.least_part, 0.0, 0.5, "", "of the area: smaller pieces join their neighbours");
  v("largest_px", p.largest_px, 64, 16384, "px", "largest width and height of the texture");
}

// What was picked between the views of one garment. Throws InputError where nothing was.
std::vector<std::vector<Vector3d>> borders_of(const std::string& garment, const Picks& picks) {
  const std::string prefix = "border_" + garment + "_";
  std::vector<std::vector<Vector3d>> borders;
  for (const auto& [name, parts] : picks.points) {
    if (name.rfind(prefix, 0) != 0) continue;
    for (const PickedPoints& part : parts)
      if (part.frame == "model" && !part.points.empty()) borders.push_back(part.points);
  }
  if (borders.empty())
    throw InputError("picks/model/" + prefix + "*",
                     "found none for this garment in a frame whose pose is known; texture=thesis_four_way expected the "
                     "borders between the views: pick each with MeshLab (PickPoints) in order along " +
                         garment + ".ply of a run, and save it as .pp (scenes/README.md, \"Picks\")");
  return borders;
}

// The photographs side by side, and where each of them lies.
struct PhotoMap {
  cv::Mat texture;
  std::vector<double> left_px;
  double scale = 1;  // texels per pixel
};
PhotoMap side_by_side(const std::vector<ColorView>& views, int largest_px) {
  PhotoMap map;
  int width = 0, height = 0;
  for (const ColorView& view : views) {
    map.left_px.push_back(width + kMargin_px);
    width += view.color.cols + 2 * kMargin_px;
    height = std::max(height, view.color.rows + 2 * kMargin_px);
  }
  map.texture = cv::Mat(height, width, CV_8UC3, kGrey);
  for (std::size_t i = 0; i < views.size(); ++i) {
    cv::Mat bytes, framed;
    views[i].color.convertTo(bytes, CV_8UC3);
    cv::copyMakeBorder(bytes, framed, kMargin_px, kMargin_px, kMargin_px, kMargin_px, cv::BORDER_REPLICATE);
    const int left = static_cast<int>(map.left_px[i]) - kMargin_px;
    framed.copyTo(map.texture(cv::Rect(left, 0, framed.cols, framed.rows)));
  }
  const int largest = std::max(width, height);
  if (largest <= largest_px) return map;
  map.scale = static_cast<double>(largest_px) / largest;
  cv::resize(map.texture, map.texture, {}, map.scale, map.scale, cv::INTER_AREA);
  return map;
}

// Whether the view shows the triangle's middle at all: turned towards it and on the garment.
bool shown(const ColorView& view, const Mesh& mesh, const Vector3i& t, const ViewParams& params) {
  const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  const Vector3d middle = (a + b + c) / 3;
  Vector2d pixel;
  double z_m = 0;
  return (b - a).cross(c - a).dot(view.eye - middle) > 0 && view.project(middle, pixel, z_m) &&
         view.trust_at(pixel, z_m, params.occluder_gap_m) > 0;
}

// Texture coordinates of a triangle in its own photograph; the map's corner where it does not project into it.
std::array<Vector2f, 3> projected(const ColorView& view, double left_px, const PhotoMap& map, const Mesh& mesh,
                                  const Vector3i& t) {
  std::array<Vector2f, 3> uv;
  for (int k = 0; k < 3; ++k) {
    Vector2d pixel;
    double z_m = 0;
    if (!view.project(mesh.vertices[t[k]], pixel, z_m)) pixel = Vector2d::Zero();
    pixel.x() = std::clamp<double>(pixel.x(), 0, view.color.cols - 1) + left_px + 0.5;
    pixel.y() = std::clamp<double>(pixel.y(), 0, view.color.rows - 1) + kMargin_px + 0.5;
    uv[k] = Vector2f(static_cast<float>(map.scale * pixel.x() / map.texture.cols),
                     static_cast<float>(map.scale * pixel.y() / map.texture.rows));
  }
  return uv;
}

// A garment from its views, and the part of its area that they do not show.
TexturedMesh projected_parts(const GarmentViews& garment, const std::vector<std::vector<Vector3d>>& borders,
                             const ThesisFourWayParams& params, double& unseen_part) {
  const Mesh& mesh = *garment.mesh;
  unseen_part = 1;
  TexturedMesh result{mesh, {}, cv::Mat(kNoTexture_px, kNoTexture_px, CV_8UC3, kGrey)};
  result.corner_uv.assign(mesh.triangles.size(), {Vector2f(0, 0), Vector2f(0, 1), Vector2f(1, 1)});
  if (garment.views.empty() || mesh.triangles.empty()) return result;
  const std::vector<int> view_of = parts_between(mesh, borders, garment.views, params.parts);
  const PhotoMap map = side_by_side(garment.views, params.largest_px);
  result.texture = map.texture;
  double whole = 0, seen = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const ColorView& view = garment.views[view_of[t]];
    const Vector3i& corners = mesh.triangles[t];
    result.corner_uv[t] = projected(view, map.left_px[view_of[t]], map, mesh, corners);
    const double area = triangle_area_m2(mesh, corners);
    whole += area;
    if (shown(view, mesh, corners, params.view)) seen += area;
  }
  if (whole > 0) unseen_part = 1 - seen / whole;
  return result;
}

TexturedGarments thesis_four_way(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                                 const Registration& registration, const FilledViews& filled,
                                 const OpenGarments& opened, const ThesisFourWayParams& params, const Picks& picks) {
  auto garments = garment_views(session, calibration, naked, registration, filled, opened, params.view);
  garments = levelled_exposure(std::move(garments), params.gain, params.view);
  TexturedGarments result;
  for (const auto& [name, garment] : garments)
    result.garments[name] = projected_parts(garment, borders_of(name, picks), params, result.unseen_part[name]);
  return result;
}

const Texture::Variant thesis_four_way_variant{"thesis_four_way", thesis_four_way, {"border_*"}};

}  // namespace
}  // namespace dressform
