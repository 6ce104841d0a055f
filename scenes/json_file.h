#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/camera.h"
#include "scenes/error.h"

namespace dressform {

// One value of a JSON file together with the place it stands at, so that every error names file and field
// ("session.json: shots.naked"). Members that nobody asks for are left alone.
class JsonValue {
 public:
  JsonValue(std::string where, nlohmann::json value) : where_(std::move(where)), value_(std::move(value)) {}

  JsonValue at(const std::string& name) const;  // throws InputError when it is not there
  bool has(const std::string& name) const { return value_.is_object() && value_.contains(name); }
  std::vector<std::string> names() const;   // of an object's members
  std::vector<JsonValue> elements() const;  // of an array

  std::string text() const;
  bool flag() const;
  int whole(int minimum, int maximum) const;
  double number(double minimum = -1e6, double maximum = 1e6) const;
  std::vector<double> numbers(int count) const;
  Vector3d vector3() const;
  std::vector<std::string> texts() const;
  // Rows of a rigid 4 x 4 matrix. Rounded to 1e-4 at most; brought to the nearest rotation when rounded at all.
  Isometry3d rigid() const;
  Camera camera() const;  // one that can be: session_limits.h

  const std::string& where() const { return where_; }
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(where_, problem); }

 private:
  std::string where_;
  nlohmann::json value_;
};

// Parses a file. Throws InputError naming it.
JsonValue read_json(const std::filesystem::path& file);
// The same for a file of a known format and version: `format` and `version` must be there.
JsonValue read_json(const std::filesystem::path& file, const std::string& format, int version);
// Writes to a temporary name, then renames. Numbers are the shortest text that reads back the same.
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& value);

nlohmann::ordered_json to_json(const Isometry3d& matrix);
nlohmann::ordered_json to_json(const Vector3d& vector);
nlohmann::ordered_json to_json(const Camera& camera);

}  // namespace dressform
