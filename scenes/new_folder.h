#pragma once
#include <filesystem>

namespace dressform {

// A folder in the making: files go to a temporary folder beside it, and keep() gives that its name, so that a folder
// that is there is whole. Without keep() nothing remains.
class NewFolder {
 public:
  // Throws InputError when `folder` exists or cannot be written.
  explicit NewFolder(const std::filesystem::path& folder);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  void keep();

 private:
  std::filesystem::path target_, temporary_;
  bool kept_ = false;
};

}  // namespace dressform
