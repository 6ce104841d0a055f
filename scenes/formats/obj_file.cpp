#include "scenes/formats/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "scenes/error.h"
#include "scenes/formats/file_mesh.h"
#include "scenes/formats/mtl.h"

namespace dressform {
namespace {

using Corner = ObjFile::Corner;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

class Reader {
 public:
  Reader(const std::filesystem::path& path, const std::string& text) : path_(path), text_(text) {}

  ObjFile read() {
    std::size_t at = text_.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0;
    while (at < text_.size()) {
      ++line_;
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      std::string_view words(text_.data() + at, end - at);
      at = end + 1;
      while (!words.empty() && is_blank(words.front())) words.remove_prefix(1);
      if (words.empty() || words.front() == '#') continue;
      if (goes_on(words)) words = joined_lines(words, at);
      read_line(words);
    }
    check_corners();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& problem) const {
    throw InputError(path_.string() + ":" + std::to_string(line), problem);
  }

  static bool goes_on(std::string_view words) {
    while (!words.empty() && words.back() == '\r') words.remove_suffix(1);
    return !words.empty() && words.back() == '\\';
  }

  // A line that ends in a backslash with those it goes on in.
  std::string_view joined_lines(std::string_view words, std::size_t& at) {
    joined_.clear();
    while (true) {
      const bool more = goes_on(words);
      joined_.append(words.substr(0, more ? words.rfind('\\') : words.size())).push_back(' ');
      if (!more || at >= text_.size()) return joined_;
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      words = std::string_view(text_.data() + at, end - at);
      at = end + 1;
      ++extra_lines_;
    }
  }

  void read_line(std::string_view words) {
    const std::size_t size = std::min(words.find_first_of(" \t\r"), words.size());
    const std::string_view keyword = words.substr(0, size);
    words.remove_prefix(size);
    if (keyword == "v")
      read_vertex(words);
    else if (keyword == "vt")
      read_uv(words);
    else if (keyword == "f" || keyword == "fo")
      read_face(words);
    else if (keyword == "usemtl")
      use_material(std::string(trimmed(words)));
    else if (keyword == "mtllib")
      file_.libraries.emplace_back(trimmed(words));
    line_ += extra_lines_;
    extra_lines_ = 0;
  }

  // Up to `most` finite numbers; `least` at least.
  int read_numbers(std::string_view words, int least, int most, double* numbers) const {
    const char *at = words.data(), *end = at + words.size();
    for (int count = 0;; ++count) {
      while (at < end && (is_blank(*at) || *at == '+')) ++at;
      if (count >= least && (at == end || *at == '#')) return count;
      if (count == most) return count;
      const auto [stop, error] = std::from_chars(at, end, numbers[count]);
      if (error == std::errc::invalid_argument || (stop < end && !is_blank(*stop)) || !std::isfinite(numbers[count]))
        fail(line_, "found \"" + std::string(at, std::min(end, at + 20)) + "\"; expected " + std::to_string(least) +
                        " finite numbers, with decimal points and blanks between");
      at = stop;
    }
  }

  void read_vertex(std::string_view words) {
    double n[7];
    const int count = read_numbers(words, 3, 7, n);
    if (file_.vertices.size() >= kMostVertices)
      fail(line_, "found more than " + std::to_string(kMostVertices) + " vertices; expected a garment or a body");
    file_.vertices.emplace_back(n[0], n[1], n[2]);
    if (count < 6) return;
    const double* rgb = n + (count == 7 ? 4 : 3);
    file_.colors.resize(file_.vertices.size(), Vector3f::Ones());
    file_.colors.back() = Vector3d(rgb[0], rgb[1], rgb[2]).cast<float>();
  }

  void read_uv(std::string_view words) {
    double n[2] = {0, 0};
    if (read_numbers(words, 1, 2, n) == 1) n[1] = 0;
    file_.uv.emplace_back(static_cast<float>(n[0]), static_cast<float>(n[1]));
  }

  // A number of a list of `count`, from 1 on, or counted back from its end.
  static int index_of(long number, std::size_t count) {
    const long index = number > 0 ? number - 1 : static_cast<long>(count) + number;
    return index >= 0 && index < std::numeric_limits<int>::max() ? static_cast<int>(index) : -1;
  }

  void read_face(std::string_view words) {
    const std::size_t first = file_.corners.size();
    const char *at = words.data(), *end = at + words.size();
    while (true) {
      while (at < end && is_blank(*at)) ++at;
      if (at == end) break;
      at = read_corner(at, end);
    }
    if (file_.corners.size() - first < 3)
      fail(line_, "found a face with fewer than three corners; expected three or more");
    file_.polygons.push_back({file_.corners.size(), line_, material_});
  }

  const char* read_corner(const char* at, const char* end) {
    const char* const start = at;
    long number[3] = {0, 0, 0};
    bool good = false;
    for (int k = 0; k < 3; ++k) {
      const auto [stop, error] = std::from_chars(at, end, number[k]);
      const bool left_out = stop == at && (stop == end || *stop == '/' || is_blank(*stop));  // "1//3", "1//", "1/2/"
      good = error == std::errc{} || (k > 0 && left_out);
      at = stop;
      if (!good || at == end || *at != '/') break;
      ++at;
    }
    const Corner corner{index_of(number[0], file_.vertices.size()), index_of(number[1], file_.uv.size())};
    good = good && (at == end || is_blank(*at)) && number[0] != 0;
    if (!good || corner.vertex < 0 || (number[1] != 0 && corner.uv < 0))
      fail(line_, "found the corner \"" + std::string(start, std::find_if(start, end, is_blank)).substr(0, 30) +
                      "\", which does not exist; expected numbers of an OBJ's vertices, from 1 on");
    file_.corners.push_back(number[1] == 0 ? Corner{corner.vertex, -1} : corner);
    return at;
  }

  void use_material(const std::string& name) {
    const auto known = std::find(file_.materials.begin(), file_.materials.end(), name);
    material_ = static_cast<int>(known - file_.materials.begin());
    if (known == file_.materials.end()) file_.materials.push_back(name);
  }

  // Faces may name vertices that come after them.
  void check_corners() const {
    const auto vertices = static_cast<int>(file_.vertices.size()), uv = static_cast<int>(file_.uv.size());
    std::size_t at = 0;
    for (const auto& polygon : file_.polygons)
      for (; at < polygon.end; ++at)
        if (file_.corners[at].vertex >= vertices || file_.corners[at].uv >= uv)
          fail(polygon.line,
               "a face names a vertex or texture coordinate that does not exist; expected corners among the " +
                   std::to_string(vertices) + " vertices and " + std::to_string(uv) + " texture coordinates");
  }

  const std::filesystem::path& path_;
  const std::string& text_;
  ObjFile file_;
  std::string joined_;
  int line_ = 0, extra_lines_ = 0, material_ = -1;
};

}  // namespace

ObjFile read_obj_file(const std::filesystem::path& path, const std::string& text) { return Reader(path, text).read(); }

}  // namespace dressform
