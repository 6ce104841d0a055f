#include "render/renderer.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "render/drawing.h"
#include "render/render_target.h"

namespace dressform {
namespace {

void check_request(const RenderView& view, const std::vector<RenderItem>& items, const RenderOptions& options) {
  if (view.camera.width <= 0 || view.camera.height <= 0 || !(view.camera.fx > 0) || !(view.camera.fy > 0))
    throw std::invalid_argument("render: the camera needs a size and focal lengths");
  if (options.samples != 1 && options.samples != 4) throw std::invalid_argument("render: samples must be 1 or 4");
  for (const RenderItem& item : items) check_item(item);
}

// Colours come multiplied by their coverage; images with a transparent background are stored without.
cv::Mat unmultiplied(const cv::Mat& bgra) {
  cv::Mat result = bgra.clone();
  result.forEach<cv::Vec4b>([](cv::Vec4b& pixel, const int*) {
    if (pixel[3] == 0) return;
    for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<uchar>((pixel[c] * 255 + pixel[3] / 2) / pixel[3]);
  });
  return result;
}

// Twice the pixels each way, for machines without multisampling.
Camera doubled(const Camera& camera) {
  Camera result = camera;
  result.width *= 2;
  result.height *= 2;
  result.fx *= 2;
  result.fy *= 2;
  result.cx = 2 * camera.cx + 0.5;
  result.cy = 2 * camera.cy + 0.5;
  return result;
}

}  // namespace

struct Renderer::Context {
  GlContext gl;
  Programs programs{gl};
  std::unique_ptr<RenderTarget> target;

  cv::Mat draw(const UploadedItems& items, const RenderView& view, const RenderOptions& options, bool coverage) {
    const Camera& camera = view.camera;
    if (!target || !target->fits(camera.width, camera.height, options.samples)) {
      target.reset();
      target = std::make_unique<RenderTarget>(gl, camera.width, camera.height, options.samples);
    }
    target->bind();
    const Eigen::Vector3f back = options.transparent_background ? Eigen::Vector3f::Zero() : options.background;
    gl.gl.ClearColor(back.x(), back.y(), back.z(), options.transparent_background ? 0.f : 1.f);
    gl.gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    items.draw(programs, view, coverage);
    cv::Mat image = target->read();
    gl.check("drawing an image");
    return image;
  }

  cv::Mat antialiased(const UploadedItems& items, const RenderView& view, const RenderOptions& options) {
    if (options.samples <= gl.max_samples) return draw(items, view, options, false);
    RenderOptions single = options;
    single.samples = 1;
    const cv::Mat large = draw(items, {doubled(view.camera), view.camera_from_world}, single, false);
    cv::Mat image;
    cv::resize(large, image, {view.camera.width, view.camera.height}, 0, 0, cv::INTER_AREA);
    return image;
  }
};

Renderer::Renderer() : context_(std::make_unique<Context>()) {}
Renderer::~Renderer() {
  if (context_) context_->gl.make_current();
}

std::vector<cv::Mat> Renderer::render(const std::vector<RenderView>& views, const std::vector<RenderItem>& items,
                                      const RenderOptions& options) {
  for (const RenderView& view : views) check_request(view, items, options);
  context_->gl.make_current();
  const UploadedItems uploaded(context_->gl, items);
  std::vector<cv::Mat> images;
  for (const RenderView& view : views) {
    const cv::Mat bgra = context_->antialiased(uploaded, view, options);
    cv::Mat image;
    if (options.transparent_background) image = unmultiplied(bgra);
    if (!options.transparent_background) cv::cvtColor(bgra, image, cv::COLOR_BGRA2BGR);
    images.push_back(image);
  }
  return images;
}

cv::Mat Renderer::render(const RenderView& view, const std::vector<RenderItem>& items, const RenderOptions& options) {
  return render(std::vector<RenderView>{view}, items, options).front();
}

cv::Mat Renderer::mask(const RenderView& view, const std::vector<RenderItem>& items) {
  RenderOptions options;
  options.samples = 1;
  options.transparent_background = true;
  check_request(view, items, options);
  context_->gl.make_current();
  const UploadedItems uploaded(context_->gl, items);
  cv::Mat coverage;
  cv::extractChannel(context_->draw(uploaded, view, options, true), coverage, 3);
  return coverage;
}

}  // namespace dressform
