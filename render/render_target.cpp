#include "render/render_target.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace dressform {

RenderTarget::RenderTarget(GlContext& context, int width, int height, int samples)
    : context_(context), width_(width), height_(height), samples_(samples) {
  drawn_ = make(std::min(samples, context.max_samples), drawn_color_, &drawn_depth_);
  resolved_ = make(1, resolved_color_, nullptr);
}

RenderTarget::~RenderTarget() {
  const Gl& gl = context_.gl;
  const unsigned framebuffers[] = {drawn_, resolved_};
  const unsigned renderbuffers[] = {drawn_color_, drawn_depth_, resolved_color_};
  gl.DeleteFramebuffers(2, framebuffers);
  gl.DeleteRenderbuffers(3, renderbuffers);
}

unsigned RenderTarget::make(int samples, unsigned& color, unsigned* depth) {
  const Gl& gl = context_.gl;
  const int count = samples > 1 ? samples : 0;  // 0: one sample, no multisampling
  unsigned framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.GenRenderbuffers(1, &color);
  gl.BindRenderbuffer(GL_RENDERBUFFER, color);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_RGBA8, width_, height_);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  if (depth) {
    gl.GenRenderbuffers(1, depth);
    gl.BindRenderbuffer(GL_RENDERBUFFER, *depth);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_DEPTH_COMPONENT32F, width_, height_);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, *depth);
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL cannot draw images of " + std::to_string(width_) + " x " +
                             std::to_string(height_));
  return framebuffer;
}

void RenderTarget::bind() {
  context_.gl.BindFramebuffer(GL_FRAMEBUFFER, drawn_);
  context_.gl.Viewport(0, 0, width_, height_);
}

cv::Mat RenderTarget::read() {
  const Gl& gl = context_.gl;
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  gl.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, resolved_);
  cv::Mat image(height_, width_, CV_8UC4);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width_, height_, GL_BGRA, GL_UNSIGNED_BYTE, image.data);
  return image;
}

}  // namespace dressform
