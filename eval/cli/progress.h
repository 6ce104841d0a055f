#pragma once
#include <string>

namespace dressform {

// Progress on standard error: a line that changes on a terminal, plain lines otherwise, nothing when quiet.
class Progress {
 public:
  explicit Progress(bool quiet);
  // What is going on now; `done` of `total` when known (total > 0). Plain output prints only about every tenth part.
  void update(const std::string& what, int done = 0, int total = 0);
  // A finished step with its note, e.g. "fuse_naked", "12.3 s".
  void finish(const std::string& what, const std::string& note);

 private:
  bool quiet_, terminal_;
  int last_tenth_ = -1;
};

std::string seconds_text(double seconds);

}  // namespace dressform
