#pragma once
#include <toml++/toml.h>

#include <string>
#include <vector>

#include "scenes/error.h"
#include "scenes/fields.h"

namespace dressform {

// Where a node stands: "file:line:column".
std::string where_of(const toml::node& node);

// A node as a value of one type. `name` is the key in messages, e.g. "fuse.voxel_m". All throw InputError with file,
// line and column for a value of another type, out of [minimum, maximum] (NaN is), or that is none of `choices` (empty:
// any text).
double number_in(const toml::node& node, const std::string& name, double minimum, double maximum,
                 const std::string& unit);
int whole_number_in(const toml::node& node, const std::string& name, int minimum, int maximum, const std::string& unit);
bool flag_in(const toml::node& node, const std::string& name);
std::string word_in(const toml::node& node, const std::string& name, const std::vector<std::string>& choices);

// The node as a value of the described parameter's own type, in its range.
FieldValue checked_value(const toml::node& node, const std::string& name, const FieldInfo& field);

[[noreturn]] void wrong_value(const toml::node& node, const std::string& name, const std::string& expected);

// "a, b, c", or "none".
std::string listed(const std::vector<std::string>& words);

}  // namespace dressform
