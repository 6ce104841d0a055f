#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "eval/gate/nuisance.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Distances = std::map<std::string, std::vector<double>>;

fs::path nuisance_file(const fs::path& golden) { return golden / "nuisance.json"; }

void check_distances(const Distances& lists, std::size_t places, const std::string& what) {
  for (const auto& [name, list] : lists) {
    if (list.size() != places)
      throw GoldenError(what + "." + name + ": found " + std::to_string(list.size()) +
                        " numbers; expected one for each of " + std::to_string(places) + " environments");
    for (const double value : list)
      if (!(value >= 0)) throw GoldenError(what + "." + name + ": found a distance below 0; expected 0 or more");
  }
}

}  // namespace

std::optional<MeasuredNuisance> read_nuisance(const fs::path& golden) {
  const fs::path file = nuisance_file(golden);
  std::ifstream in(file);
  if (!in) return {};
  const json text = json::parse(in, nullptr, false);
  if (!text.is_object() || text.value("format", json()) != json("dressform-nuisance") ||
      text.value("version", json()) != json(1))
    throw GoldenError(file.string() + ": corrupt; expected JSON of format dressform-nuisance, version 1");
  try {
    MeasuredNuisance result;
    for (const auto& place : text.at("environments"))
      result.places.push_back({place.at("name").get<std::string>(), place.at("environment").get<Environment>(),
                               place.at("changed_steps").get<int>()});
    result.cases = text.at("cases").get<std::vector<std::string>>();
    result.metrics = text.at("metrics").get<Distances>();
    result.pictures = text.at("pictures").get<Distances>();
    result.status_changes = text.at("status_changes").get<std::vector<std::string>>();
    check_distances(result.metrics, result.places.size(), file.string() + ": metrics");
    check_distances(result.pictures, result.places.size(), file.string() + ": pictures");
    const std::set<std::string> known{"flip", "mean_levels", "worst_tile_flip", "worst_tile_levels"};
    for (const auto& [name, list] : result.pictures)
      if (!known.count(name))
        throw GoldenError(file.string() + ": pictures." + name +
                          ": unknown; expected flip, mean_levels, worst_tile_flip, worst_tile_levels");
    return result;
  } catch (const json::exception& error) {
    throw GoldenError(file.string() + ": corrupt (" + error.what() + ")");
  }
}

void write_nuisance(const fs::path& golden, const MeasuredNuisance& nuisance) {
  json places = json::array();
  for (const auto& place : nuisance.places)
    places.push_back(
        {{"name", place.name}, {"environment", place.environment}, {"changed_steps", place.changed_steps}});
  const json text = {{"format", "dressform-nuisance"},
                     {"version", 1},
                     {"environments", places},
                     {"cases", nuisance.cases},
                     {"metrics", nuisance.metrics},
                     {"pictures", nuisance.pictures},
                     {"status_changes", nuisance.status_changes}};
  fs::create_directories(golden);
  write_file_atomically(nuisance_file(golden), text.dump(1) + "\n");
}

}  // namespace dressform
