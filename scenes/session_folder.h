#pragma once
#include <filesystem>

#include "scenes/capture_session.h"

namespace dressform {

// A capture session in the making, for writers that do not hold all its images at once. Files go to a temporary folder
// beside `folder`; finish() adds session.json and calibration.json and gives it its name. Without finish() nothing
// remains.
class SessionFolder {
 public:
  // Throws InputError when `folder` exists or cannot be written.
  explicit SessionFolder(const std::filesystem::path& folder);
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }

  // `outline` is the session; of its images only the number counts, they are not looked at.
  void finish(const CaptureSession& outline);

 private:
  std::filesystem::path target_, temporary_;
  bool finished_ = false;
};

}  // namespace dressform
