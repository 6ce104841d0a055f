#include "scenes/formats/mtl.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scenes/file_bytes.h"

namespace dressform {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// Takes the next word off `text`.
std::string_view next_word(std::string_view& text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  std::size_t size = 0;
  while (size < text.size() && !is_blank(text[size])) ++size;
  const std::string_view word = text.substr(0, size);
  text.remove_prefix(size);
  return word;
}

std::optional<float> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  float value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return {};
  return value;
}

// Up to three numbers that follow, where the format leaves the later ones out.
std::vector<float> next_numbers(std::string_view& text) {
  std::vector<float> numbers;
  while (numbers.size() < 3) {
    std::string_view rest = text;
    const auto number = number_of(next_word(rest));
    if (!number) break;
    numbers.push_back(*number);
    text = rest;
  }
  return numbers;
}

// Reads one library line by line.
class Reader {
 public:
  Reader(const std::filesystem::path& path, std::map<std::string, MtlMaterial>& materials)
      : path_(path), materials_(materials) {}

  void read_line(int line, std::string_view text) {
    where_ = path_.string() + ":" + std::to_string(line);
    const std::string_view keyword = next_word(text);
    if (keyword == "newmtl")
      start(std::string(trimmed(text)));
    else if (!current_)
      return;
    else if (keyword == "Kd")
      read_color(text);
    else if (keyword == "d" || keyword == "Tr")
      read_opacity(keyword, text);
    else if (keyword == "map_Kd")
      read_map(keyword, text, current_->color_file, color_lie_);
    else if (keyword == "map_d")
      read_map(keyword, text, current_->opacity_file, opacity_lie_);
  }

  void finish() {
    if (current_ && !current_->color_file.empty() && current_->material.tint.isZero())
      current_->material.tint.setOnes();  // black times the image: some programs write 0 0 0 beside every image
    if (current_) current_->scale_offset = current_->color_file.empty() ? opacity_lie_ : color_lie_;
    if (current_ && !current_->opacity_file.empty() && !current_->color_file.empty() && color_lie_ != opacity_lie_)
      fault("map_d lies elsewhere than map_Kd; expected the same -s and -o for both");
    current_ = nullptr;
  }

 private:
  using Lie = std::array<Vector2f, 2>;

  void start(const std::string& name) {
    finish();
    color_lie_ = opacity_lie_ = MtlMaterial{}.scale_offset;
    says_d_ = false;
    const auto [at, fresh] = materials_.try_emplace(name);
    if (!fresh) return;  // known already: its lines are passed over
    current_ = &at->second;
    current_->material.name = name;
    current_->material.transparency = Transparency::holes;  // where the image has an alpha channel
  }

  void fault(const std::string& problem) {
    if (!current_->material.fault)
      current_->material.fault.emplace(where_, "material \"" + current_->material.name + "\": " + problem);
  }

  void read_color(std::string_view text) {
    const std::vector<float> rgb = next_numbers(text);
    if (rgb.size() != 1 && rgb.size() != 3)
      return fault("found Kd" + std::string(text.substr(0, 40)) + "; expected three numbers from 0 to 1");
    for (int k = 0; k < 3; ++k) current_->material.tint[k] = std::clamp(rgb[rgb.size() == 3 ? k : 0], 0.0f, 1.0f);
  }

  void read_opacity(std::string_view keyword, std::string_view text) {
    if (keyword == "Tr" && says_d_) return;  // d says the same, and some programs mean the opposite with Tr
    std::string_view rest = text;
    if (next_word(rest) == "-halo") text = rest;
    const auto value = number_of(next_word(text));
    says_d_ = keyword == "d";
    if (!value) return fault("found " + std::string(keyword) + " without a number; expected one from 0 to 1");
    const float opacity = says_d_ ? *value : 1 - *value;
    constexpr float kOpaque = 0.999f;  // rounding in the file
    if (opacity < kOpaque)
      fault("found " + std::string(keyword) + " " + std::to_string(*value) +
            ", an alpha (opacity) below 1; expected opaque cloth (d 1)");
  }

  // Options that only a bump map, a reflection or filtering know are passed over.
  void read_map(std::string_view keyword, std::string_view text, std::filesystem::path& file, Lie& lie) {
    lie = MtlMaterial{}.scale_offset;
    while (true) {
      std::string_view rest = text;
      const std::string_view option = next_word(rest);
      if (option.size() < 2 || option.front() != '-') break;
      if (option == "-s" || option == "-o" || option == "-t") {
        const std::vector<float> numbers = next_numbers(rest);
        if (numbers.empty()) return fault("found " + std::string(option) + " without numbers; expected one to three");
        if (option == "-t" && std::any_of(numbers.begin(), numbers.end(), [](float n) { return n != 0; }))
          return fault(std::string(keyword) + " has the option -t (turbulence); expected an image without it");
        Vector2f& value = lie[option == "-s" ? 0 : 1];
        for (std::size_t k = 0; option != "-t" && k < numbers.size() && k < 2; ++k)
          value[static_cast<int>(k)] = numbers[k];
      } else if (option == "-mm") {
        const std::vector<float> numbers = next_numbers(rest);
        if (numbers.size() < 2 || numbers[0] != 0 || numbers[1] != 1)
          return fault(std::string(keyword) + " has the option -mm (base and gain); expected an image without it");
      } else if (option == "-clamp") {
        if (next_word(rest) == "on") current_->material.wrap = {Wrap::nothing, Wrap::nothing};
      } else if (option == "-cc") {
        if (next_word(rest) == "on")
          return fault(std::string(keyword) + " has the option -cc (colour correction); expected an image without it");
      } else if (option == "-blendu" || option == "-blendv" || option == "-bm" || option == "-boost" ||
                 option == "-imfchan" || option == "-texres" || option == "-type") {
        next_word(rest);
      } else {
        return fault(std::string(keyword) + " has the option " + std::string(option) +
                     "; expected -s, -o, -bm, -clamp, -blendu, -blendv, -boost, -imfchan, -mm, -texres or -type");
      }
      text = rest;
    }
    const std::string_view name = trimmed(text);
    if (name.empty()) return fault(std::string(keyword) + " names no file; expected a PNG or JPEG");
    file = beside(path_, name);
  }

  const std::filesystem::path& path_;
  std::map<std::string, MtlMaterial>& materials_;
  MtlMaterial* current_ = nullptr;
  Lie color_lie_, opacity_lie_;
  bool says_d_ = false;
  std::string where_;
};

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto is_outer = [](char c) { return is_blank(c) || c == '\r' || c == '\n'; };
  while (!text.empty() && is_outer(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_outer(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

std::filesystem::path beside(const std::filesystem::path& file, std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  while (path.rfind("./", 0) == 0) path.erase(0, 2);
  return file.parent_path() / path;
}

void read_mtl(const std::filesystem::path& path, std::map<std::string, MtlMaterial>& materials) {
  constexpr std::size_t kMostBytes = 1 << 24;
  const std::string text = read_file_bytes(path, kMostBytes);
  Reader reader(path, materials);
  std::size_t at = text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0;
  for (int line = 1; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view words(text.data() + at, end - at);
    if (!words.empty() && words.back() == '\r') words.remove_suffix(1);
    reader.read_line(line, words);
    at = end + 1;
  }
  reader.finish();
}

}  // namespace dressform
