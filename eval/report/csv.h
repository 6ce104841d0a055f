#pragma once
#include <string>

namespace dressform {

// One field of a line of comma-separated values (RFC 4180): quoted where a comma, a quote or a line break would part
// it.
std::string csv_field(const std::string& text);

}  // namespace dressform
