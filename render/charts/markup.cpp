#include "render/charts/markup.h"

namespace dressform {

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string base64(const std::string& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned value = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += digits[value >> 18 & 63];
    text += digits[value >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[value >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[value & 63] : '=';
  }
  return text;
}

}  // namespace dressform
