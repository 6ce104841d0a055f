#include "scenes/json_file.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "scenes/fields.h"
#include "scenes/session_limits.h"
#include "scenes/small_solvers.h"

namespace dressform {
namespace {

constexpr double kRounded = 1e-4, kExact = 1e-12;
constexpr int kMostNested = 64;  // levels: copies and messages of a value go down them one by one

std::string shown(const nlohmann::json& value) {
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

// The likely reason, in brackets; `off`: how far R R^T is from the identity.
std::string why_not_rigid(const Eigen::Matrix4d& matrix, double off) {
  const Eigen::Matrix3d written = matrix.topLeftCorner<3, 3>();
  if (matrix.col(3) == Eigen::Vector4d(0, 0, 0, 1) && matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    return " (looks transposed: the translation stands in the last row)";
  if (off <= kRounded && written.determinant() < 0) return " (its determinant is -1: a mirror image)";
  const double scale = std::cbrt(std::abs(written.determinant()));
  const Eigen::Matrix3d unit = written / std::max(scale, 1e-12);
  if ((unit * unit.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kRounded)
    return fmt::format(" (its axes are {:.4g} long instead of 1)", scale);
  return fmt::format(" (R times its transpose is off the identity by {:.3g})", off);
}

}  // namespace

JsonValue JsonValue::at(const std::string& name) const {
  const std::string full = where_ + (where_.find(": ") == where_.npos ? ": " : ".") + name;
  if (!value_.is_object()) fail("found " + shown(value_) + "; expected an object");
  if (!value_.contains(name)) throw InputError(full, "is missing");
  return {full, value_.at(name)};
}

std::vector<std::string> JsonValue::names() const {
  if (!value_.is_object()) fail("found " + shown(value_) + "; expected an object");
  std::vector<std::string> result;
  for (const auto& [name, member] : value_.items()) result.push_back(name);
  return result;
}

std::vector<JsonValue> JsonValue::elements() const {
  if (!value_.is_array()) fail("found " + shown(value_) + "; expected an array");
  std::vector<JsonValue> result;
  for (std::size_t i = 0; i < value_.size(); ++i)
    result.emplace_back(where_ + "[" + std::to_string(i) + "]", value_[i]);
  return result;
}

std::string JsonValue::text() const {
  if (!value_.is_string()) fail("found " + shown(value_) + "; expected text");
  return value_.get<std::string>();
}

bool JsonValue::flag() const {
  if (!value_.is_boolean()) fail("found " + shown(value_) + "; expected true or false");
  return value_.get<bool>();
}

int JsonValue::whole(int minimum, int maximum) const {
  if (!value_.is_number_integer() || value_.get<double>() < minimum || value_.get<double>() > maximum)
    fail("found " + shown(value_) + "; expected a whole number from " + std::to_string(minimum) + " to " +
         std::to_string(maximum));
  return value_.get<int>();
}

double JsonValue::number(double minimum, double maximum) const {
  if (!value_.is_number()) fail("found " + shown(value_) + "; expected a finite number");
  const double number = value_.get<double>();
  if (!(number >= minimum && number <= maximum))
    fail("found " + shown(value_) + "; expected " + to_text(FieldValue(minimum)) + " to " +
         to_text(FieldValue(maximum)));
  return number;
}

std::vector<double> JsonValue::numbers(int count) const {
  std::vector<double> result;
  for (const auto& element : elements()) result.push_back(element.number());
  if (static_cast<int>(result.size()) != count)
    fail("found " + std::to_string(result.size()) + " numbers; expected " + std::to_string(count));
  return result;
}

Vector3d JsonValue::vector3() const {
  const auto list = numbers(3);
  return {list[0], list[1], list[2]};
}

std::vector<std::string> JsonValue::texts() const {
  std::vector<std::string> result;
  for (const auto& element : elements()) result.push_back(element.text());
  return result;
}

Isometry3d JsonValue::rigid() const {
  const auto rows = elements();
  if (rows.size() != 4) fail("found " + std::to_string(rows.size()) + " rows; expected 4 rows of 4");
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) matrix.row(row) = Eigen::RowVector4d::Map(rows[row].numbers(4).data());
  const Eigen::Matrix3d written = matrix.topLeftCorner<3, 3>();
  const double off = (written * written.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRounded) || written.determinant() < 0 || matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    fail("found a matrix that is no rotation and translation" + why_not_rigid(matrix, off) +
         "; expected a rigid motion, 4 rows of 4, the translation (metres) in the last column");
  Isometry3d result = Isometry3d::Identity();
  result.linear() = written;
  if (off > kExact) {
    result.linear() = nearest_rotation(written);
  }
  result.translation() = matrix.topRightCorner<3, 1>();
  return result;
}

Camera JsonValue::camera() const {
  Camera camera;
  camera.width = at("width").whole(1, 16384);
  camera.height = at("height").whole(1, 16384);
  camera.fx = at("fx").number();
  camera.fy = at("fy").number();
  camera.cx = at("cx").number();
  camera.cy = at("cy").number();
  const auto distortion = at("distortion").numbers(5);
  std::copy(distortion.begin(), distortion.end(), camera.distortion.begin());
  if (const auto found = problem_with(camera)) at(found->field).fail(found->problem);
  return camera;
}

JsonValue read_json(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t(1) << 28;  // a thousand times what any of these files holds
  std::error_code error_code;
  if (!std::filesystem::exists(file, error_code)) throw InputError(file.string(), "is missing; expected a file");
  if (!std::filesystem::is_regular_file(file, error_code))
    throw InputError(file.string(), "found a folder or device; expected a file");
  const auto bytes = std::filesystem::file_size(file, error_code);
  if (bytes > kMostBytes)
    throw InputError(file.string(),
                     fmt::format("found {} MB; expected JSON of {} MB at most", bytes >> 20, kMostBytes >> 20));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "cannot be read; expected a readable file");
  const auto check_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMostNested)
      throw InputError(file.string(), fmt::format("found values nested deeper than {} levels", kMostNested));
    return true;
  };
  try {
    return {file.string(), nlohmann::json::parse(stream, check_depth)};
  } catch (const nlohmann::json::exception& error) {
    const std::string text = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    throw InputError(file.string(), "is not JSON with finite numbers: " + text.substr(text.find(']') + 2));
  }
}

JsonValue read_json(const std::filesystem::path& file, const std::string& format, int version) {
  JsonValue value = read_json(file);
  const auto found = value.at("format");
  if (found.text() != format) found.fail("found \"" + found.text() + "\"; expected \"" + format + "\"");
  const auto number = value.at("version");
  if (number.number() != version)
    number.fail("found " + to_text(FieldValue(number.number())) + "; expected " + std::to_string(version));
  return value;
}

void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& value) {
  const std::filesystem::path temporary = file.string() + ".part";
  {
    std::ofstream stream(temporary, std::ios::binary);
    stream << value.dump(1) << '\n';
    if (!stream.flush()) throw InputError(file.string(), "cannot be written; expected a writable folder");
  }
  std::filesystem::rename(temporary, file);
}

nlohmann::ordered_json to_json(const Isometry3d& matrix) {
  auto rows = nlohmann::ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d numbers = matrix.matrix().row(row);
    rows.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
  }
  return rows;
}

nlohmann::ordered_json to_json(const Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

nlohmann::ordered_json to_json(const Camera& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

}  // namespace dressform
