#pragma once
#include <string>

namespace dressform {

// Text as it stands in HTML and SVG, in content and in quoted attributes.
std::string html_escaped(const std::string& text);

// RFC 4648, with padding: for data URIs.
std::string base64(const std::string& bytes);

}  // namespace dressform
