#pragma once
#include <map>
#include <string>

namespace dressform {

// What a number depends on besides what was asked: the program's version, its code (captures and all stages, found by
// include closure), the versions of all declared metrics, and the libraries. Numbers of different signatures are never
// compared.
using Signature = std::map<std::string, std::string>;
Signature program_signature();

// What differs, for people: "code 1f.. and 2e.., opencv 4.6.0 and 4.8.1"; empty where nothing does.
std::string difference_of(const Signature& a, const Signature& b);

}  // namespace dressform
