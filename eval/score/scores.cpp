#include "eval/score/scores.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "scenes/error.h"

namespace dressform {

using nlohmann::json;

const ScoreRow* Scores::find(const std::string& stage, const std::string& metric) const {
  for (const auto& row : rows)
    if (row.stage == stage && row.metric == metric) return &row;
  return nullptr;
}

std::string scores_to_json(const Scores& scores) {
  json rows = json::array();
  for (const auto& row : scores.rows)
    rows.push_back({{"stage", row.stage},
                    {"metric", row.metric},
                    {"unit", row.unit},
                    {"value", std::isfinite(row.value) ? json(row.value) : json()},
                    {"status", row.status},
                    {"n_samples", row.n_samples}});
  const json text = {{"format", "dressform-scores"}, {"version", 1},        {"scene", scores.scene},
                     {"variant", scores.variant},    {"seed", scores.seed}, {"scores", rows}};
  return text.dump(1) + "\n";
}

Scores scores_from_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string(), "can't be read; expected a scores.json");
  try {
    const json text = json::parse(in);
    if (text.at("format") != "dressform-scores" || text.at("version") != 1)
      throw InputError(file.string(), "is not dressform-scores version 1");
    Scores scores{text.at("scene"), text.at("variant"), text.at("seed"), {}};
    for (const auto& row : text.at("scores")) {
      const double value =
          row.at("value").is_null() ? std::numeric_limits<double>::quiet_NaN() : row.at("value").get<double>();
      scores.rows.push_back(
          {row.at("stage"), row.at("metric"), row.at("unit"), value, row.at("status"), row.at("n_samples")});
    }
    return scores;
  } catch (const json::exception& error) {
    throw InputError(file.string(), std::string("damaged (") + error.what() + ")");
  }
}

std::string scores_to_csv(const Scores& scores, const std::string& run_id) {
  std::string text = "run_id,scene,variant,stage,seed,metric,unit,value,status,n_samples\n";
  for (const auto& row : scores.rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", run_id, scores.scene, scores.variant, row.stage, scores.seed,
                        row.metric, row.unit, std::isfinite(row.value) ? fmt::format("{}", row.value) : "nan",
                        row.status, row.n_samples);
  return text;
}

}  // namespace dressform
