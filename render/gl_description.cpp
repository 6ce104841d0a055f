#include "render/gl_description.h"

#include <GL/osmesa.h>

#include <stdexcept>

#include "render/gl_context.h"

namespace dressform {

std::string gl_description() {
  const GlContext context;
  const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(OSMesaGetProcAddress("glGetString"));
  if (!get_string) throw std::runtime_error("OpenGL has no function glGetString");
  std::string text;
  for (const GLenum what : {GL_VERSION, GL_RENDERER}) {
    const auto* word = reinterpret_cast<const char*>(get_string(what));
    text += (text.empty() ? "" : ", ") + std::string(word ? word : "unknown");
  }
  return text;
}

}  // namespace dressform
