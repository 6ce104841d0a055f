#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "eval/studies/plan.h"

namespace dressform {

// What a variant asks for; without its name and the files it brings, what its cells are named by.
nlohmann::json variant_json(const StudyVariant& variant, bool with_name);

std::string plan_json(const StudyPlan& plan);
// Throws InputError naming the file where it is damaged, or asks for metrics that this program does not have.
StudyPlan plan_from_json(const std::filesystem::path& file);

}  // namespace dressform
