#include "eval/report/viewer_code.h"

namespace dressform {

std::string viewer_code_gzip() {
#if __has_include("model_viewer.inc")
  static const unsigned char bytes[] = {
#include "model_viewer.inc"
  };
  return std::string(reinterpret_cast<const char*>(bytes), sizeof bytes);
#else
  return "";
#endif
}

}  // namespace dressform
