#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scenes/camera.h"
#include "scenes/toml_value.h"

namespace dressform {

// All TOML files that one scene is made of, in the order they were opened; keeps their nodes alive.
class TomlFiles {
 public:
  struct File {
    std::string name;  // as the scene names it
    std::string text;
    std::unique_ptr<toml::table> table;
  };
  // Parses `path`; `referrer` is "file:line:column" of the text that named it, or empty. Throws InputError.
  const toml::table& open(const std::filesystem::path& path, const std::string& name, const std::string& referrer);
  const std::vector<File>& files() const { return files_; }

 private:
  std::vector<File> files_;
};

// A path written in a TOML file, taken from that file's folder. Throws InputError when there is no such file.
std::filesystem::path resolved_path(const toml::node& node, const std::string& text);

// One table of a scene, read strictly: every key is taken by name with type and range, and finish() rejects what
// nobody asked for. The table may be written in place or in a file of its own (`body = "bodies/x.toml"`, or
// `[body] file = "bodies/x.toml"` and keys that override it): the layers are searched in order.
class TomlSection {
 public:
  TomlSection(TomlFiles& files, const toml::table& table, std::string name);
  // `node` is a table or the name of a file that holds it.
  TomlSection(TomlFiles& files, const toml::node& node, std::string name);

  // The visitor of scenes/fields.h.
  void operator()(const char* name, double& value, double minimum, double maximum, const char* unit, const char* doc);
  void operator()(const char* name, int& value, int minimum, int maximum, const char* unit, const char* doc);
  void operator()(const char* name, bool& value, const char* doc);
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices, const char* doc);

  void path(const char* name, std::filesystem::path& value);
  void texts(const char* name, std::vector<std::string>& value);
  void vector(const char* name, Eigen::VectorXd& value, int size, double minimum, double maximum, const char* unit);
  void vector3(const char* name, Vector3d& value, double minimum, double maximum, const char* unit);
  // Three rows of three; rounded tables are brought back to the nearest rotation, anything further off is rejected.
  void rotation(const char* name, Eigen::Matrix3d& value);

  const toml::node* find(const char* name);  // counts as known
  bool has(const char* name) { return find(name) != nullptr; }
  void child(const char* name, const std::function<void(TomlSection&)>& read);  // does nothing where it is absent
  // Elements of an array of tables (or of file names).
  void children(const char* name, const std::function<void(TomlSection&)>& read);
  // All keys of the table `name` as parameter values of a variant (checked later, by the variant).
  FieldValues values(const char* name);

  void finish() const;  // throws InputError for a key that was never asked for
  [[noreturn]] void fail(const char* name, const std::string& problem) const;

 private:
  std::string full_name(const std::string& name) const;  // with the section's before it
  void add_layer(const toml::table& table);
  TomlFiles& files_;
  std::string name_;
  std::vector<const toml::table*> layers_;
  std::vector<std::string> known_;
};

}  // namespace dressform
