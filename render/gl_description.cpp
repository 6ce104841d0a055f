#include "render/gl_description.h"

#include <GL/osmesa.h>

#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace dressform {

std::string gl_description() {
  constexpr int kSide = 16;  // of the buffer that OSMesa wants; nothing is drawn
  using Handle = std::unique_ptr<std::remove_pointer_t<OSMesaContext>, void (*)(OSMesaContext)>;
  const Handle context(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr), OSMesaDestroyContext);
  std::vector<unsigned char> buffer(kSide * kSide * 4);
  if (!context || !OSMesaMakeCurrent(context.get(), buffer.data(), GL_UNSIGNED_BYTE, kSide, kSide))
    throw std::runtime_error("no off-screen OpenGL context can be made");
  using GetString = const GLubyte* (*)(GLenum);
  const auto get_string = reinterpret_cast<GetString>(OSMesaGetProcAddress("glGetString"));
  if (!get_string) throw std::runtime_error("OpenGL has no function glGetString");
  std::string text;
  for (const GLenum what : {GL_VERSION, GL_RENDERER}) {
    const auto* word = reinterpret_cast<const char*>(get_string(what));
    text += (text.empty() ? "" : ", ") + std::string(word ? word : "unknown");
  }
  return text;
}

}  // namespace dressform
