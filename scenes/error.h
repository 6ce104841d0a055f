#pragma once
#include <stdexcept>
#include <string>

namespace dressform {

// What the caller got wrong: a file, a field, a parameter, a name. Thrown where it is detected and caught only in
// `main` (exit code 2) and in a study cell. The message is one line: "<where>: <what was found>; expected <what>".
class InputError : public std::runtime_error {
 public:
  // where: "file.toml:12:3", "session.json: shots.naked", "--set fuse.voxel_m"; problem: found and expected.
  InputError(const std::string& where, const std::string& problem)
      : std::runtime_error(where + ": " + problem), where_(where) {}
  const std::string& where() const { return where_; }

 private:
  std::string where_;
};

}  // namespace dressform
