#pragma once
#include <opencv2/core/mat.hpp>

#include "render/gl_context.h"

namespace dressform {

// An image to draw into: colour and depth with `samples` per pixel, which are averaged when it is read.
class RenderTarget {
 public:
  // samples is lowered to what OpenGL offers; sizes it cannot make throw std::runtime_error.
  RenderTarget(GlContext& context, int width, int height, int samples);
  ~RenderTarget();
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;

  bool fits(int width, int height, int samples) const {
    return width == width_ && height == height_ && samples == samples_;
  }
  void bind();
  cv::Mat read();  // 8-bit BGRA, first row on top (the projection is upside down for OpenGL)

 private:
  unsigned make(int samples, unsigned& color, unsigned* depth);

  GlContext& context_;
  int width_, height_, samples_;
  unsigned drawn_ = 0, drawn_color_ = 0, drawn_depth_ = 0;
  unsigned resolved_ = 0, resolved_color_ = 0;
};

}  // namespace dressform
