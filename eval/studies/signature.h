#pragma once
#include <map>
#include <string>

namespace dressform {

// What a number depends on besides what was asked (scale, sensor model, seed and variant are the cell's own): the
// program's version, its code (captures, all stages, pictures and scores, found by include closure), the versions of
// all declared metrics, compiler and libraries. Numbers of different signatures are never compared. The commit is in it
// for people and does not count: two commits with the same code give the same numbers.
using Signature = std::map<std::string, std::string>;
Signature program_signature();

// Without what does not count: equal where numbers may be compared.
Signature comparable(Signature signature);

// What differs, for people: "code 1f.. and 2e.., opencv 4.6.0 and 4.8.1"; empty where nothing does.
std::string difference_of(const Signature& a, const Signature& b);

}  // namespace dressform
