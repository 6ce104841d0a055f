#pragma once
#include <string>

namespace dressform {

// The script that turns models in a page (@google/model-viewer, Apache-2.0), compressed with gzip; empty where the
// program was built without it (scripts/fetch_viewer).
std::string viewer_code_gzip();

}  // namespace dressform
