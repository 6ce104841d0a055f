#include "scenes/import/opencv_yaml.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "scenes/file_bytes.h"

namespace dressform {
namespace {

int print_nothing(int, const char*, const char*, const char*, int, void*) { return 0; }

// OpenCV reports what it throws on the terminal as well, unless told not to.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(cv::redirectError(print_nothing)) {}
  ~QuietOpenCv() { cv::redirectError(before_); }

 private:
  cv::ErrorCallback before_;
};

}  // namespace

OpenCvYaml::OpenCvYaml(const std::filesystem::path& file) : file_(file.string()) {
  const std::string text = read_file_bytes(file);
  const QuietOpenCv quiet;
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    const cv::FileNode root = storage.root();
    if (!storage.isOpened() || !root.isMap()) throw InputError(file_, "is damaged; expected OpenCV's YAML");
    for (const auto& key : root.keys()) {
      const cv::FileNode node = root[key];
      if (node.isReal() || node.isInt())
        numbers_[key] = node.real();
      else if (node.isMap())
        node >> matrices_[key];
    }
  } catch (const cv::Exception&) {
    throw InputError(file_, "is damaged; expected OpenCV's YAML");
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
