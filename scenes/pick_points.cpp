#include "scenes/pick_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <pugixml.hpp>

#include "scenes/error.h"

namespace dressform {
namespace {

// A finite number that is all of `text`.
std::optional<double> number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string shown(std::string_view text) {
  std::string result = "\"" + std::string(text.substr(0, 40)) + (text.size() > 40 ? "...\"" : "\"");
  for (char& letter : result)
    if (static_cast<unsigned char>(letter) < 32) letter = '?';
  return result;
}

// Lines of a text by offsets that do not fall: all of them together read it once.
class Lines {
 public:
  explicit Lines(const std::string& text) : text_(text) {}
  // Lines count from 1. An offset outside the text is that of its nearer end.
  int at(std::ptrdiff_t offset) {
    const auto end = std::clamp<std::ptrdiff_t>(offset, seen_, static_cast<std::ptrdiff_t>(text_.size()));
    line_ += static_cast<int>(std::count(text_.begin() + seen_, text_.begin() + end, '\n'));
    seen_ = end;
    return line_;
  }

 private:
  const std::string& text_;
  std::ptrdiff_t seen_ = 0;
  int line_ = 1;
};

[[noreturn]] void fail(const std::string& where, int line, const std::string& problem) {
  throw InputError(where + ":" + std::to_string(line), problem);
}

void check_room(const std::string& where, int line, std::size_t points) {
  if (points >= static_cast<std::size_t>(kMostPickedPoints))
    fail(where, line, fmt::format("found more than {} points; expected what a person picked", kMostPickedPoints));
}

Vector3d point_of(const std::string& where, int line, const pugi::xml_node& node) {
  Vector3d point;
  const char* names[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto attribute = node.attribute(names[axis]);
    if (!attribute) fail(where, line, std::string("found a point without ") + names[axis] + "; expected x, y and z");
    const auto value = number(attribute.value());
    if (!value)
      fail(where, line,
           std::string("found ") + names[axis] + " = " + shown(attribute.value()) + "; expected a finite number");
    point[axis] = *value;
  }
  return point;
}

// The parts of a line between its separators: commas if it has any, else semicolons, else tabs or blanks.
std::vector<std::string_view> parts_of(std::string_view line) {
  const char* separators = line.find(',') != line.npos ? "," : line.find(';') != line.npos ? ";" : " \t";
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = line.find_first_of(separators);
    std::string_view part = line.substr(0, end);
    while (!part.empty() && (part.front() == ' ' || part.front() == '\t')) part.remove_prefix(1);
    while (!part.empty() && (part.back() == ' ' || part.back() == '\t')) part.remove_suffix(1);
    if (!part.empty() || *separators != ' ') parts.push_back(part);
    if (end == line.npos) return parts;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

std::vector<Vector3d> points_of_pick_points(const std::string& where, const std::string& text) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(text.data(), text.size());
  if (!parsed)
    fail(where, Lines(text).at(parsed.offset),
         std::string("is not XML (") + parsed.description() + "); expected MeshLab's PickPoints");
  const auto root = document.child("PickedPoints");
  if (!root)
    fail(where, 1,
         "found " + shown(document.document_element().name()) +
             " as the outermost element; expected PickedPoints, as MeshLab's PickPoints tool saves it");
  Lines lines(text);
  std::vector<Vector3d> points;
  for (const auto node : root.children("point")) {
    if (std::string_view(node.attribute("active").value()) == "0") continue;
    const int line = lines.at(node.offset_debug());
    check_room(where, line, points.size());
    points.push_back(point_of(where, line, node));
  }
  return points;
}

std::vector<Vector3d> points_of_list(const std::string& where, const std::string& text) {
  std::vector<Vector3d> points;
  std::size_t columns = 0, at = 0;
  for (int line = 1; at < text.size(); ++line) {
    const auto end = std::min(text.find('\n', at), text.size());
    std::string_view row(text.data() + at, end - at);
    at = end + 1;
    if (line == 1 && row.substr(0, 3) == "\xEF\xBB\xBF") row.remove_prefix(3);
    while (!row.empty() && (row.back() == '\r' || row.back() == ' ' || row.back() == '\t')) row.remove_suffix(1);
    while (!row.empty() && (row.front() == ' ' || row.front() == '\t')) row.remove_prefix(1);
    if (row.empty() || row.substr(0, 2) == "//") continue;
    const auto parts = parts_of(row);
    if (parts.size() != 3 && parts.size() != 4)
      fail(where, line,
           fmt::format("found {} column{}; expected x,y,z or label,x,y,z (with points for decimals)", parts.size(),
                       parts.size() == 1 ? "" : "s"));
    if (columns != 0 && parts.size() != columns)
      fail(where, line, fmt::format("found {} columns; expected {} as in the lines before", parts.size(), columns));
    columns = parts.size();
    check_room(where, line, points.size());
    Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
      const auto part = parts[columns - 3 + static_cast<std::size_t>(axis)];
      const auto value = number(part);
      if (!value) fail(where, line, "found " + shown(part) + "; expected a finite number (with a point for decimals)");
      point[axis] = *value;
    }
    points.push_back(point);
  }
  return points;
}

std::string pick_points_text(const std::vector<Vector3d>& points) {
  std::string text = "<!DOCTYPE PickedPoints>\n<PickedPoints>\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format(" <point x=\"{}\" y=\"{}\" z=\"{}\" name=\"{}\" active=\"1\"/>\n", points[i].x(), points[i].y(),
                        points[i].z(), i);
  return text + "</PickedPoints>\n";
}

}  // namespace dressform
