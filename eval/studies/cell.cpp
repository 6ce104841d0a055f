#include "eval/studies/cell.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

using nlohmann::json;

json row_json(const ScoreRow& row) {
  return {row.stage,  row.metric,   row.unit, std::isfinite(row.value) ? json(row.value) : json(),
          row.status, row.n_samples};
}

ScoreRow row_from(const json& row) {
  const json& value = row.at(3);
  return {row.at(0), row.at(1),
          row.at(2), value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>(),
          row.at(4), row.at(5)};
}

CellResult cell_from(const json& text) {
  CellResult cell;
  cell.id = text.at("cell");
  cell.signature = text.at("signature").get<Signature>();
  cell.scene = text.at("scene");
  cell.seed = text.at("seed");
  cell.scale = text.at("scale");
  cell.failed = text.at("status") != "ok";
  cell.reason = text.at("reason");
  cell.problems = text.at("problems").get<std::vector<std::string>>();
  for (const auto& row : text.at("scores")) cell.scores.push_back(row_from(row));
  return cell;
}

}  // namespace

double CellCost::pipeline_seconds() const {
  double sum = 0;
  for (const auto& [stage, seconds] : stage_seconds) sum += seconds;
  return sum;
}

std::string cell_json(const CellResult& cell) {
  json rows = json::array();
  for (const auto& row : cell.scores) rows.push_back(row_json(row));
  const json text = {{"format", "dressform-cell"},
                     {"version", 1},
                     {"cell", cell.id},
                     {"signature", cell.signature},
                     {"scene", cell.scene},
                     {"seed", cell.seed},
                     {"scale", cell.scale},
                     {"status", cell.failed ? "failed" : "ok"},
                     {"reason", cell.reason},
                     {"problems", cell.problems},
                     {"scores", std::move(rows)}};
  return text.dump() + "\n";
}

CellResult read_cell(const std::filesystem::path& file) {
  try {
    const json text = json::parse(read_file_bytes(file));
    if (text.at("format") != "dressform-cell" || text.at("version") != 1)
      throw InputError(file.string(), "is not a dressform-cell of version 1");
    CellResult cell = cell_from(text);
    if (cell.id != file.stem().string())
      throw InputError(file.string(), "holds the cell " + cell.id + "; expected the one of its name");
    return cell;
  } catch (const json::exception& error) {
    throw InputError(file.string(), std::string("damaged (") + error.what() + "); expected a cell of a study");
  }
}

std::string cost_json(const CellCost& cost) {
  return json{{"capture_seconds", cost.capture_seconds},
              {"stage_seconds", cost.stage_seconds},
              {"peak_memory_mb", cost.peak_memory_mb}}
             .dump() +
         "\n";
}

std::optional<CellCost> read_cost(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  const json text = json::parse(read_file_bytes(file), nullptr, false);
  if (!text.is_object() || !text.contains("stage_seconds")) return {};
  try {
    CellCost cost;
    cost.capture_seconds = text.at("capture_seconds");
    cost.stage_seconds = text.at("stage_seconds").get<decltype(cost.stage_seconds)>();
    cost.peak_memory_mb = text.at("peak_memory_mb");
    return cost;
  } catch (const json::exception&) {  // a damaged record of times is no record
    return {};
  }
}

}  // namespace dressform
