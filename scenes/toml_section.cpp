#include "scenes/toml_section.h"

#include <Eigen/LU>
#include <algorithm>
#include <fstream>

#include "scenes/small_solvers.h"

namespace dressform {
namespace {

constexpr double kRoundedRotation = 5e-3;  // four decimals of the thesis's tables leave 2e-4

const toml::array& array_of(const toml::node& node, const std::string& name, int size) {
  const auto* array = node.as_array();
  const std::string expected = "an array of " + std::to_string(size);
  if (!array) wrong_value(node, name, expected);
  if (static_cast<int>(array->size()) != size)
    throw InputError(where_of(node),
                     name + ": found " + std::to_string(array->size()) + " elements; expected " + std::to_string(size));
  return *array;
}

std::string read_text(const std::filesystem::path& path, const std::string& referrer) {
  std::ifstream file(path, std::ios::binary);
  if (std::filesystem::is_directory(path) || !file) {
    if (referrer.empty()) throw InputError(path.string(), "cannot be read; expected a TOML file");
    throw InputError(referrer, "found \"" + path.string() + "\", which cannot be read; expected a TOML file");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::filesystem::path resolved_path(const toml::node& node, const std::string& text) {
  const std::filesystem::path folder = std::filesystem::path(*node.source().path).parent_path();
  const auto path = (folder / text).lexically_normal();
  if (text.empty() || !std::filesystem::is_regular_file(path))
    throw InputError(where_of(node), "found \"" + text + "\"; expected a file, looked for " + path.string());
  return path;
}

const toml::table& TomlFiles::open(const std::filesystem::path& path, const std::string& name,
                                   const std::string& referrer) {
  File file{name, read_text(path, referrer), nullptr};
  try {
    file.table = std::make_unique<toml::table>(toml::parse(file.text, path.string()));
  } catch (const toml::parse_error& error) {
    const auto& at = error.source().begin;
    throw InputError(path.string() + ":" + std::to_string(at.line) + ":" + std::to_string(at.column),
                     std::string(error.description()));
  }
  files_.push_back(std::move(file));
  return *files_.back().table;
}

TomlSection::TomlSection(TomlFiles& files, const toml::table& table, std::string name)
    : files_(files), name_(std::move(name)) {
  add_layer(table);
}

TomlSection::TomlSection(TomlFiles& files, const toml::node& node, std::string name)
    : files_(files), name_(std::move(name)) {
  if (const auto* table = node.as_table()) {
    add_layer(*table);
    return;
  }
  const auto* text = node.as_string();
  if (!text) wrong_value(node, name_, "a table or the name of a TOML file");
  add_layer(files_.open(resolved_path(node, text->get()), text->get(), where_of(node)));
}

void TomlSection::add_layer(const toml::table& table) {
  if (layers_.size() >= 8) throw InputError(where_of(table), name_ + ".file: more than 8 files refer to one another");
  layers_.push_back(&table);
  const auto* file = table.get("file");
  if (!file || name_.empty()) return;  // the scene itself is not part of another file
  const auto* text = file->as_string();
  if (!text) wrong_value(*file, name_ + ".file", "the name of a TOML file");
  add_layer(files_.open(resolved_path(*file, text->get()), text->get(), where_of(*file)));
}

std::string TomlSection::full_name(const std::string& name) const { return name_.empty() ? name : name_ + "." + name; }

const toml::node* TomlSection::find(const char* name) {
  if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.push_back(name);
  for (const auto* layer : layers_)
    if (const auto* node = layer->get(name)) return node;
  return nullptr;
}

void TomlSection::operator()(const char* name, double& value, double minimum, double maximum, const char* unit,
                             const char*) {
  if (const auto* node = find(name)) value = number_in(*node, full_name(name), minimum, maximum, unit);
}

void TomlSection::operator()(const char* name, int& value, int minimum, int maximum, const char* unit, const char*) {
  if (const auto* node = find(name)) value = whole_number_in(*node, full_name(name), minimum, maximum, unit);
}

void TomlSection::operator()(const char* name, bool& value, const char*) {
  if (const auto* node = find(name)) value = flag_in(*node, full_name(name));
}

void TomlSection::operator()(const char* name, std::string& value, const std::vector<std::string>& choices,
                             const char*) {
  if (const auto* node = find(name)) value = word_in(*node, full_name(name), choices);
}

void TomlSection::path(const char* name, std::filesystem::path& value) {
  std::string text;
  (*this)(name, text, {}, "");
  if (const auto* node = find(name)) value = resolved_path(*node, text);
}

void TomlSection::texts(const char* name, std::vector<std::string>& value) {
  const auto* node = find(name);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) wrong_value(*node, full_name(name), "an array of text");
  value.clear();
  for (const auto& element : *array) {
    if (!element.is_string()) wrong_value(element, full_name(name), "text");
    value.push_back(element.as_string()->get());
  }
}

void TomlSection::vector(const char* name, Eigen::VectorXd& value, int size, double minimum, double maximum,
                         const char* unit) {
  const auto* node = find(name);
  if (!node) return;
  const std::string full = full_name(name);
  const auto& array = array_of(*node, full, size);
  value.resize(size);
  for (int i = 0; i < size; ++i) {
    value[i] = number_in(array[i], full, minimum, maximum, unit);
  }
}

void TomlSection::vector3(const char* name, Vector3d& value, double minimum, double maximum, const char* unit) {
  Eigen::VectorXd numbers = value;
  vector(name, numbers, 3, minimum, maximum, unit);
  value = numbers;
}

void TomlSection::rotation(const char* name, Eigen::Matrix3d& value) {
  const auto* node = find(name);
  if (!node) return;
  const std::string full = full_name(name);
  Eigen::Matrix3d written;
  const auto& rows = array_of(*node, full, 3);
  for (int row = 0; row < 3; ++row) {
    const auto& numbers = array_of(rows[row], full, 3);
    for (int column = 0; column < 3; ++column) {
      written(row, column) = number_in(numbers[column], full, -1.01, 1.01, "");
    }
  }
  const Eigen::Matrix3d nearest = nearest_rotation(written);  // far off, for a mirror
  const double off = (nearest - written).cwiseAbs().maxCoeff();
  if (!(off <= kRoundedRotation))
    fail(name, "found a matrix that is no rotation; expected one to within " + to_text(FieldValue(kRoundedRotation)));
  value = nearest;
}

void TomlSection::child(const char* name, const std::function<void(TomlSection&)>& read) {
  const auto* node = find(name);
  if (!node) return;
  TomlSection section(files_, *node, name);
  read(section);
  section.finish();
}

void TomlSection::children(const char* name, const std::function<void(TomlSection&)>& read) {
  const auto* node = find(name);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) wrong_value(*node, full_name(name), std::string("[[") + name + "]] tables");
  for (const auto& element : *array) {
    TomlSection section(files_, element, name);
    read(section);
    section.finish();
  }
}

FieldValues TomlSection::values(const char* name) {
  FieldValues result;
  child(name, [&](TomlSection& section) {
    for (auto layer = section.layers_.rbegin(); layer != section.layers_.rend(); ++layer)
      for (const auto& [key, node] : **layer) {
        const std::string text(key.str());
        section.known_.push_back(text);
        if (node.is_boolean())
          result[text] = node.as_boolean()->get();
        else if (node.is_integer())
          result[text] = static_cast<int>(std::clamp<std::int64_t>(node.as_integer()->get(), INT32_MIN, INT32_MAX));
        else if (node.is_floating_point())
          result[text] = node.as_floating_point()->get();
        else if (node.is_string())
          result[text] = node.as_string()->get();
        else
          wrong_value(node, text, "a number, text, true or false");
      }
  });
  return result;
}

void TomlSection::finish() const {
  for (const auto* layer : layers_)
    for (const auto& [key, node] : *layer) {
      const std::string text(key.str());
      if (std::find(known_.begin(), known_.end(), text) != known_.end()) continue;
      if (text == "file" && !name_.empty()) continue;
      const auto at = key.source().begin;
      const auto file = where_of(node).substr(0, where_of(node).find_last_of(':'));
      throw InputError(
          file.substr(0, file.find_last_of(':')) + ":" + std::to_string(at.line) + ":" + std::to_string(at.column),
          "unknown key \"" + text + "\"" + (name_.empty() ? "" : " in " + name_) + "; known are " + listed(known_));
    }
}

void TomlSection::fail(const char* name, const std::string& problem) const {
  const toml::node* node = layers_.front();
  for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer)
    if (const auto* found = (*layer)->get(name)) node = found;
  throw InputError(where_of(*node), (*name ? full_name(name) : name_) + ": " + problem);
}

}  // namespace dressform
