#include "render/charts/canvas.h"

namespace dressform {
namespace {

// The last byte of the UTF-8 letter before `end` begins at the returned place.
std::size_t letter_before(const std::string& text, std::size_t end) {
  do --end;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
  return end;
}

}  // namespace

Ink palette_ink(int color, double opacity) {
  static const Ink inks[] = {{40, 40, 40},    {0, 114, 178}, {213, 94, 0},  {0, 158, 115},
                             {204, 121, 167}, {230, 159, 0}, {86, 180, 233}};
  Ink ink = inks[color % 7];
  ink.opacity = opacity;
  return ink;
}

void Canvas::rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size_mm, const Ink& ink, double width_mm) {
  const Eigen::Vector2d across(size_mm.x(), 0), down(0, size_mm.y());
  polyline({corner, corner + across, corner + size_mm, corner + down, corner}, ink, width_mm);
}

std::string clipped_text(const std::string& text, double size_mm, double width_mm) {
  if (text_width_mm(text, size_mm) <= width_mm) return text;
  for (std::size_t end = text.size(); end > 0;) {
    end = letter_before(text, end);
    const std::string part = text.substr(0, end) + "…";
    if (text_width_mm(part, size_mm) <= width_mm) return part;
  }
  return "";
}

std::vector<std::string> wrapped_text(const std::string& text, double size_mm, double width_mm) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at), longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && text_width_mm(longer, size_mm) > width_mm) {
      lines.push_back(line);
      line = word;
    } else {
      line = longer;
    }
    at = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace dressform
