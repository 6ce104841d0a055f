#pragma once
#include <filesystem>

#include "scenes/json_file.h"

namespace dressform {

// A YAML file of OpenCV's FileStorage that holds numbers and matrices. Every error is one line naming file and key.
class OpenCvYaml {
 public:
  // Throws InputError where the file is missing or no such YAML.
  explicit OpenCvYaml(const std::filesystem::path& file);

  double number(const std::string& key) const;
  // A matrix of doubles of rows x columns; 0: any number. Throws InputError where it is missing, of another size or not
  // finite.
  cv::Mat matrix(const std::string& key, int rows, int columns) const;
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 private:
  std::string file_;
  std::map<std::string, cv::Mat> matrices_;
  std::map<std::string, double> numbers_;
};

}  // namespace dressform
