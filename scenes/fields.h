#pragma once
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace dressform {

// A parameter struct is described once, by a function template found by argument-dependent lookup:
//
//   struct TsdfParams { double voxel_m = 0.004; };
//   template <class V> void fields(V& v, TsdfParams& p) {
//     v("voxel_m", p.voxel_m, 0.001, 0.02, "m", "edge of one voxel");
//   }
//
// That one description serves TOML and JSON reading and writing, range checks, cache keys, --help and sweeps.

using FieldValue = std::variant<bool, int, double, std::string>;
using FieldValues = std::map<std::string, FieldValue>;

// One described field. `minimum` and `maximum` hold the value's own type for int and double, and are unused otherwise.
struct FieldInfo {
  std::string name;
  FieldValue value;
  FieldValue minimum;
  FieldValue maximum;
  std::vector<std::string> choices;  // for text: the allowed words; empty: any text
  std::string unit;                  // "" for none
  std::string doc;
};

// Exact, locale-free text of a value (17 significant digits), used in cache keys and files.
std::string to_text(const FieldValue& value);

// "; looks like millimetres" where a length in metres that is out of range is within it as that; else empty.
std::string likely_unit(double value, double minimum, double maximum, const std::string& unit);

// Reads `text` as a value of the same type as `like`. Throws InputError naming `where`.
FieldValue parse_field(const std::string& where, const std::string& text, const FieldValue& like);

// Visitor that lists fields with their current values.
class FieldLister {
 public:
  void operator()(const char* name, double& value, double minimum, double maximum, const char* unit, const char* doc);
  void operator()(const char* name, int& value, int minimum, int maximum, const char* unit, const char* doc);
  void operator()(const char* name, bool& value, const char* doc);
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices, const char* doc);
  std::vector<FieldInfo> fields;
};

// Visitor that assigns values by name, with type and range checks. Throws InputError naming `where`.
class FieldAssigner {
 public:
  FieldAssigner(std::string where, const FieldValues& values) : where_(std::move(where)), values_(values) {}
  void operator()(const char* name, double& value, double minimum, double maximum, const char* unit, const char* doc);
  void operator()(const char* name, int& value, int minimum, int maximum, const char* unit, const char* doc);
  void operator()(const char* name, bool& value, const char* doc);
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices, const char* doc);
  void finish() const;  // throws if a value named no field; the error lists the known names

 private:
  const FieldValue* find(const char* name);
  std::string where_;
  FieldValues values_;
  std::vector<std::string> known_;
};

template <class Params>
std::vector<FieldInfo> list_fields(Params params) {
  FieldLister lister;
  fields(lister, params);
  return lister.fields;
}

// Defaults of Params overridden by `values`. `where` prefixes error messages, e.g. "fuse.tsdf".
template <class Params>
Params assign_fields(const std::string& where, const FieldValues& values, Params params = {}) {
  FieldAssigner assigner(where, values);
  fields(assigner, params);
  assigner.finish();
  return params;
}

}  // namespace dressform
