#include "render/drawing.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "render/color_map.h"

namespace dressform {
namespace {

constexpr float kPointDiameterM = 0.0045f;

// Near and far planes that just hold the box.
std::pair<double, double> depth_range(const Eigen::AlignedBox3d& box, const Isometry3d& camera_from_world) {
  double nearest = 1e30, farthest = -1e30;
  for (int i = 0; i < 8; ++i) {
    const double z = (camera_from_world * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))).z();
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  const double far_m = std::max(farthest * 1.01 + 0.01, 0.02);
  return {std::max({nearest * 0.99 - 0.01, far_m * 1e-4, 0.005}), far_m};
}

}  // namespace

Eigen::Matrix4d clip_from_camera(const Camera& camera, double near_m, double far_m) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = 2 * camera.fx / camera.width;
  m(0, 2) = 2 * (camera.cx + 0.5) / camera.width - 1;
  m(1, 1) = 2 * camera.fy / camera.height;
  m(1, 2) = 2 * (camera.cy + 0.5) / camera.height - 1;
  m(2, 2) = (far_m + near_m) / (far_m - near_m);
  m(2, 3) = -2 * far_m * near_m / (far_m - near_m);
  m(3, 2) = 1;
  return m;
}

UploadedItems::UploadedItems(GlContext& context, const std::vector<RenderItem>& items)
    : context_(context), box_(bounding_box(items)) {
  if (!box_.isEmpty()) origin_ = box_.center();
  for (const RenderItem& item : items) upload(item);
}

UploadedItems::~UploadedItems() {
  for (const Uploaded& item : items_) {
    context_.gl.DeleteVertexArrays(1, &item.vertex_array);
    const unsigned buffers[] = {item.vertices, item.indices};
    context_.gl.DeleteBuffers(2, buffers);
    context_.gl.DeleteTextures(1, &item.image);
  }
}

void UploadedItems::upload(const RenderItem& item) {
  const DrawData data = draw_data(item, origin_);
  Uploaded up{item.shading, item.color, std::clamp(item.opacity, 0.f, 1.f), item.two_sided, item.points != nullptr};
  if (item.shading == Shading::textured || item.shading == Shading::unlit)
    up.image = upload_image(item.textured->texture, true);
  if (item.shading == Shading::scalar) up.image = upload_image(scalar_colors(), false);

  const Gl& gl = context_.gl;
  gl.GenVertexArrays(1, &up.vertex_array);
  gl.BindVertexArray(up.vertex_array);
  gl.GenBuffers(1, &up.vertices);
  gl.BindBuffer(GL_ARRAY_BUFFER, up.vertices);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.vertices.size() * sizeof(DrawVertex)),
                data.vertices.data(), GL_STATIC_DRAW);
  const std::size_t offsets[] = {offsetof(DrawVertex, position), offsetof(DrawVertex, normal),
                                 offsetof(DrawVertex, extra)};
  for (unsigned i = 0; i < 3; ++i) {
    gl.EnableVertexAttribArray(i);
    gl.VertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(DrawVertex), reinterpret_cast<const void*>(offsets[i]));
  }
  gl.GenBuffers(1, &up.indices);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, up.indices);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.indices.size() * sizeof(std::uint32_t)),
                data.indices.data(), GL_STATIC_DRAW);
  up.count = static_cast<int>(item.points ? data.vertices.size() : data.indices.size());
  items_.push_back(up);
}

unsigned UploadedItems::upload_image(const cv::Mat& image, bool filtered) {
  const Gl& gl = context_.gl;
  int largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  cv::Mat fitting = image.isContinuous() ? image : image.clone();
  if (const double shrink = static_cast<double>(largest) / std::max(image.cols, image.rows); shrink < 1)
    cv::resize(image, fitting, {}, shrink, shrink, cv::INTER_AREA);
  unsigned texture = 0;
  gl.GenTextures(1, &texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, fitting.cols, fitting.rows, 0, GL_BGR, GL_UNSIGNED_BYTE, fitting.data);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, filtered ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filtered ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  if (!filtered) return texture;
  gl.GenerateMipmap(GL_TEXTURE_2D);
  return texture;
}

void UploadedItems::draw(Programs& programs, const RenderView& view, bool coverage) const {
  if (box_.isEmpty()) return;
  const auto [near_m, far_m] = depth_range(box_, view.camera_from_world);
  const Eigen::Matrix4d camera_from_item = (view.camera_from_world * Eigen::Translation3d(origin_)).matrix();
  const Eigen::Matrix4f clip_from_item =
      (clip_from_camera(view.camera, near_m, far_m) * camera_from_item).cast<float>();
  const Gl& gl = context_.gl;
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.FrontFace(GL_CW);  // counter-clockwise as the camera sees it; the projection is upside down
  for (const bool opaque : {true, false})
    for (const Uploaded& item : items_) {
      if ((coverage || item.opacity >= 1) != opaque) continue;
      Program& program = coverage ? programs.coverage(item.points) : programs.shading(item.shading, item.points);
      program.use();
      program.set("clip_from_item", clip_from_item);
      program.set("camera_from_item", Eigen::Matrix4f(camera_from_item.cast<float>()));
      program.set("camera_from_item_rotation", Eigen::Matrix3f(camera_from_item.topLeftCorner<3, 3>().cast<float>()));
      program.set("color", item.color);
      program.set("opacity", coverage ? 1.f : item.opacity);
      program.set("scalar_grey", kNoScalarGrey / 255.f);
      program.set("point_size_px_m", static_cast<float>(kPointDiameterM * view.camera.fy));
      if (opaque) draw_item(item);
      if (!opaque) draw_nearest_surface(item);
    }
}

void UploadedItems::draw_item(const Uploaded& item) const {
  const Gl& gl = context_.gl;
  (item.two_sided ? gl.Disable : gl.Enable)(GL_CULL_FACE);
  gl.BindTexture(GL_TEXTURE_2D, item.image);
  gl.BindVertexArray(item.vertex_array);
  if (item.points) gl.DrawArrays(GL_POINTS, 0, item.count);
  if (!item.points) gl.DrawElements(GL_TRIANGLES, item.count, GL_UNSIGNED_INT, nullptr);
}

void UploadedItems::draw_nearest_surface(const Uploaded& item) const {
  const Gl& gl = context_.gl;
  gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_item(item);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_item(item);
  gl.Disable(GL_BLEND);
}

}  // namespace dressform
