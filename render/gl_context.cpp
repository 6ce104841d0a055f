#include "render/gl_context.h"

#include <GL/osmesa.h>

#include <stdexcept>
#include <string>

namespace dressform {
namespace {

constexpr int kBufferSize = 16;

}  // namespace

GlContext::GlContext() : buffer_(kBufferSize * kBufferSize * 4) {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            4,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            5,
                            0};
  handle_ = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!handle_) throw std::runtime_error("no off-screen OpenGL 4.5 core context can be made");
  make_current();
#define DRESSFORM_GL_LOAD(type, name)                                 \
  gl.name = reinterpret_cast<type>(OSMesaGetProcAddress("gl" #name)); \
  if (!gl.name) throw std::runtime_error("OpenGL has no function gl" #name);
  DRESSFORM_GL_FUNCTIONS(DRESSFORM_GL_LOAD)
#undef DRESSFORM_GL_LOAD
  gl.GetIntegerv(GL_MAX_SAMPLES, &max_samples);
}

GlContext::~GlContext() {
  if (handle_) OSMesaDestroyContext(static_cast<OSMesaContext>(handle_));
}

void GlContext::make_current() {
  if (!OSMesaMakeCurrent(static_cast<OSMesaContext>(handle_), buffer_.data(), GL_UNSIGNED_BYTE, kBufferSize,
                         kBufferSize))
    throw std::runtime_error("the off-screen OpenGL context cannot be made current");
}

void GlContext::check(const char* what) const {
  const GLenum error = gl.GetError();
  if (error != GL_NO_ERROR)
    throw std::runtime_error(std::string("OpenGL error ") + std::to_string(error) + ": " + what);
}

}  // namespace dressform
