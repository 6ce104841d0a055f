#include "eval/gate/nuisance.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "eval/score/metric.h"
#include "scenes/error.h"

namespace dressform {
namespace {

// The largest of k distances is exceeded by the next one in one of k + 1 environments, and the golden may have been
// made in one that lies on the other side of the reference: twice the largest covers both.
constexpr double kHeadroom = 2;
constexpr std::size_t kLeastPlaces = 3;  // with the reference: two distances are the least that can be left out in turn
constexpr double kBoundConfidence = 0.95;

// Half of the last digit that tables show: what nobody can see is no change. Counts are exact.
double resolution_of(const std::string& unit) {
  if (unit == "count") return 0;
  return unit == "1" || unit == "deg" ? 0.0005 : 0.005;
}
// The same of pictures: of levels and of FLIP.
const std::map<std::string, double>& picture_resolutions() {
  static const std::map<std::string, double> resolutions = {
      {"mean_levels", 0.005}, {"worst_tile_levels", 0.05}, {"flip", 0.0005}, {"worst_tile_flip", 0.005}};
  return resolutions;
}

// "surface <slot>/f_5mm@1"; empty for a row that nobody declared.
std::string declared_name(const ScoreRow& row) {
  const Metric* metric = find_metric(row.stage, row.metric);
  return metric ? fmt::format("{} {}@{}", row.stage, metric->name, metric->version) : std::string();
}

double largest_but(const std::vector<double>& distances, int left_out) {
  double largest = 0;
  for (std::size_t k = 0; k < distances.size(); ++k)
    if (static_cast<int>(k) != left_out) largest = std::max(largest, distances[k]);
  return largest;
}

// Adds a distance of place `k` to the list under a name.
void note(std::map<std::string, std::vector<double>>& lists, const std::string& name, std::size_t k, std::size_t places,
          double distance) {
  auto& list = lists[name];
  list.resize(places, 0);
  list[k] = std::max(list[k], distance);
}

void note_scores(MeasuredNuisance& result, const GoldenRun& reference, const GoldenRun& run, const std::string& where,
                 std::size_t k) {
  for (const auto& row : reference.scores.rows) {
    const std::string name = declared_name(row);
    const ScoreRow* other = run.scores.find(row.stage, row.metric);
    if (name.empty()) continue;
    if (!other || other->status != row.status) {
      result.status_changes.push_back(fmt::format("{}: {} {}: {} and {}", where, row.stage, row.metric, row.status,
                                                  other ? other->status : "none"));
    } else if (std::isfinite(row.value) && std::isfinite(other->value)) {
      note(result.metrics, name, k, result.places.size(), std::abs(other->value - row.value));
    }
  }
}

std::map<std::string, double> by_name(const PictureDifference& difference) {
  return {{"mean_levels", difference.mean_levels},
          {"worst_tile_levels", difference.worst_tile_levels},
          {"flip", difference.flip},
          {"worst_tile_flip", difference.worst_tile_flip}};
}

void note_pictures(MeasuredNuisance& result, const GoldenRun& reference, const GoldenRun& run, std::size_t k) {
  for (const auto& [stem, image] : reference.images) {
    const auto other = run.images.find(stem);
    if (other == run.images.end()) continue;
    for (const auto& [name, value] : by_name(picture_difference(image, other->second)))
      note(result.pictures, name, k, result.places.size(), value);
  }
}

const GoldenRun& run_of(const PlaceRuns& place, const std::string& name) {
  const auto found = place.runs.find(name);
  if (found == place.runs.end())
    throw InputError(place.name, "has no run of case " + name + "; expected all cases in every environment");
  return found->second;
}

}  // namespace

MeasuredNuisance measure_nuisance(const std::vector<PlaceRuns>& places) {
  MeasuredNuisance result;
  if (places.empty() || places.front().runs.empty())
    throw InputError("gate nuisance", "found no runs; expected at least one case");
  for (const auto& [name, run] : places.front().runs) result.cases.push_back(name);
  for (const auto& place : places) {
    const Environment& environment = run_of(place, result.cases.front()).environment;
    for (const auto& other : result.places)
      if (other.environment == environment)
        throw InputError(place.name, "has the environment of " + other.name +
                                         "; expected distinct ones: repeats of one are no further samples");
    result.places.push_back({place.name, environment, 0});
  }
  for (std::size_t k = 0; k < places.size(); ++k)
    for (const auto& name : result.cases) {
      const GoldenRun &reference = run_of(places.front(), name), &run = run_of(places[k], name);
      const auto bytes = compare_bytes(reference.steps, {}, run.steps, {});
      result.places[k].changed_steps += static_cast<int>(bytes.changed.size());
      note_scores(result, reference, run, places[k].name + ", " + name, k);
      note_pictures(result, reference, run, k);
    }
  return result;
}

std::size_t MeasuredNuisance::distinct() const {
  const auto moved =
      std::count_if(places.begin(), places.end(), [](const Place& each) { return each.changed_steps > 0; });
  return static_cast<std::size_t>(moved) + !places.empty();
}

bool MeasuredNuisance::usable() const { return distinct() >= kLeastPlaces; }

std::optional<double> MeasuredNuisance::tolerance(const ScoreRow& row, int left_out) const {
  const auto found = metrics.find(declared_name(row));
  if (!usable() || found == metrics.end()) return {};
  return std::max(resolution_of(row.unit), kHeadroom * largest_but(found->second, left_out));
}

PictureTolerance MeasuredNuisance::picture_tolerance(int left_out) const {
  PictureTolerance result;
  if (!usable() || pictures.size() != picture_resolutions().size()) return result;
  const auto of = [&](const char* name) {
    return std::max(picture_resolutions().at(name), kHeadroom * largest_but(pictures.at(name), left_out));
  };
  return {of("mean_levels"), of("worst_tile_levels"), of("flip"), of("worst_tile_flip"), true};
}

std::vector<LeftOutPlace> leave_one_out(const MeasuredNuisance& nuisance) {
  std::vector<LeftOutPlace> result;
  for (std::size_t k = 1; k < nuisance.places.size(); ++k) {
    if (nuisance.places[k].changed_steps == 0) continue;  // no sample: it cannot be alarmed
    LeftOutPlace place{nuisance.places[k].name, {}};
    const int left_out = static_cast<int>(k);
    for (const Metric* metric : all_metrics()) {
      const std::string name = fmt::format("{} {}@{}", metric->stage, metric->name, metric->version);
      const auto found = nuisance.metrics.find(name);
      if (found == nuisance.metrics.end()) continue;
      const double tolerance = std::max(resolution_of(metric->unit), kHeadroom * largest_but(found->second, left_out));
      if (found->second[k] > tolerance) place.alarms.push_back(name);
    }
    for (const auto& [name, distances] : nuisance.pictures)
      if (distances[k] > std::max(picture_resolutions().at(name), kHeadroom * largest_but(distances, left_out)))
        place.alarms.push_back("image " + name);
    result.push_back(place);
  }
  return result;
}

double alarm_rate_bound(int alarmed, int count) {
  if (count <= 0 || alarmed >= count) return 1;
  return boost::math::binomial::find_upper_bound_on_p(count, alarmed, 1 - kBoundConfidence);
}

}  // namespace dressform
