#include "scenes/import/opencv_yaml.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>

#include "scenes/file_bytes.h"

namespace dressform {
namespace {

// The part of YAML that OpenCV's FileStorage writes numbers and matrices in. Read by hand: OpenCV's own parser ends the
// program on some damaged files (4.6: an exception that it lets go of and throws again).
class Lines {
 public:
  Lines(const std::string& file, const std::string& text) : file_(file), in_(text) { next(); }

  bool at_end() const { return ended_; }
  const std::string& line() const { return line_; }
  bool indented() const { return !ended_ && line_[0] == ' '; }
  // Steps on to the next line that says something.
  void next() {
    while (std::getline(in_, line_)) {
      line_.erase(line_.find_last_not_of(" \t\r") + 1);
      const std::size_t first = line_.find_first_not_of(' ');
      if (first != std::string::npos && line_[first] != '#' && line_[0] != '%' && line_ != "---" && line_ != "...")
        return;
    }
    ended_ = true;
    line_.clear();
  }
  // "key: value" of this line, blanks taken off.
  std::pair<std::string, std::string> entry() const {
    const std::size_t first = line_.find_first_not_of(' '), colon = line_.find(':', first);
    if (colon == std::string::npos || (colon + 1 < line_.size() && line_[colon + 1] != ' ')) damaged();
    const std::size_t value = line_.find_first_not_of(' ', colon + 1);
    return {line_.substr(first, colon - first), value == std::string::npos ? "" : line_.substr(value)};
  }
  [[noreturn]] void damaged() const { throw InputError(file_, "is damaged; expected OpenCV's YAML"); }

 private:
  std::string file_, line_;
  std::istringstream in_;
  bool ended_ = false;
};

// A number as OpenCV writes it: "1.", "-2e-3", ".Nan", "-.Inf"; nothing where `text` is something else.
std::optional<double> number_of(const std::string& text) {
  const bool minus = !text.empty() && text[0] == '-';
  std::string rest = text.substr(minus ? 1 : 0);
  for (char& c : rest) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (rest == ".nan") return std::numeric_limits<double>::quiet_NaN();
  if (rest == ".inf") return (minus ? -1 : 1) * std::numeric_limits<double>::infinity();
  if (rest.empty() || rest.find_first_not_of("0123456789.e+-") != std::string::npos) return {};
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end != '\0') return {};
  return value;
}

// "[ 1., 2.,", and the lines up to the bracket that closes.
std::vector<double> data_of(Lines& lines, std::string text) {
  while (text.find(']') == std::string::npos) {
    lines.next();
    if (!lines.indented()) lines.damaged();
    text += lines.line();
  }
  if (text[0] != '[' || text.find(']') + 1 != text.size()) lines.damaged();
  std::istringstream in(text.substr(1, text.size() - 2));
  std::vector<double> numbers;
  for (std::string word; std::getline(in, word, ',');) {
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    const auto number = number_of(word);
    if (!number) lines.damaged();
    numbers.push_back(*number);
  }
  return numbers;
}

// The lines below "key: !!opencv-matrix".
cv::Mat matrix_of(Lines& lines) {
  double rows = 0, columns = 0;
  std::vector<double> data;
  for (; lines.indented(); lines.next()) {
    const auto [key, value] = lines.entry();
    if (key == "rows" || key == "cols") (key == "rows" ? rows : columns) = number_of(value).value_or(-1);
    if (key == "dt" && (value.size() != 1 || std::string("ucwsifd").find(value) == std::string::npos)) lines.damaged();
    if (key == "data") data = data_of(lines, value.empty() ? " " : value);
  }
  if (rows < 1 || columns < 1 || rows != std::floor(rows) || columns != std::floor(columns) ||
      rows * columns != static_cast<double>(data.size()))
    lines.damaged();
  return cv::Mat(data, true).reshape(1, static_cast<int>(rows));
}

}  // namespace

OpenCvYaml::OpenCvYaml(const std::filesystem::path& file) : file_(file.string()) {
  constexpr std::size_t kMostBytes = 1 << 20;  // a calibration is a few kilobytes
  Lines lines(file_, read_file_bytes(file, kMostBytes));
  while (!lines.at_end()) {
    if (lines.indented()) lines.damaged();
    const auto [key, value] = lines.entry();
    lines.next();
    if (value == "!!opencv-matrix") {
      matrices_[key] = matrix_of(lines);
      continue;
    }
    if (const auto number = number_of(value)) numbers_[key] = *number;
    while (lines.indented()) lines.next();  // of something else: text, a list
  }
}

double OpenCvYaml::number(const std::string& key) const {
  const auto found = numbers_.find(key);
  if (found == numbers_.end() || !std::isfinite(found->second)) fail(key, "is missing; expected a number");
  return found->second;
}

cv::Mat OpenCvYaml::matrix(const std::string& key, int rows, int columns) const {
  const auto found = matrices_.find(key);
  if (found == matrices_.end() || found->second.empty()) fail(key, "is missing; expected a matrix");
  const cv::Mat& matrix = found->second;
  if (matrix.channels() != 1 || (rows && matrix.rows != rows) || (columns && matrix.cols != columns))
    fail(key, fmt::format("found a matrix of {} x {}; expected {} x {}", matrix.rows, matrix.cols, rows, columns));
  cv::Mat result;
  matrix.convertTo(result, CV_64F);
  if (!cv::checkRange(result)) fail(key, "found a number that is not finite; expected a matrix of numbers");
  return result;
}

void OpenCvYaml::fail(const std::string& key, const std::string& problem) const {
  throw InputError(file_ + ": " + key, problem);
}

}  // namespace dressform
