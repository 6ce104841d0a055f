#include "eval/gate/doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "eval/gate/gate.h"
#include "eval/score/metric.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// Fewer distinct environments bound the rate of false alarms by no more than a third (alarm_rate_bound(0, 7) = .35).
constexpr std::size_t kEnoughPlaces = 8;
constexpr double kCreepNotice = 0.5;   // of the way to the alarm: worth a look before it rings
constexpr double kDriftNotice = 0.05;  // sum of FLIP over accepts: as far apart as two garments of other colour

class Examination {
 public:
  void grave(const std::string& where, const std::string& what) { complaints_.push_back({where, what, true}); }
  void note(const std::string& where, const std::string& what) { complaints_.push_back({where, what, false}); }
  std::vector<Complaint> take() {
    std::stable_sort(complaints_.begin(), complaints_.end(),
                     [](const Complaint& a, const Complaint& b) { return a.grave > b.grave; });
    return std::move(complaints_);
  }

 private:
  std::vector<Complaint> complaints_;
};

void examine_scores(const GoldenCase& golden, Examination& found) {
  int undeclared = 0;
  std::string example;
  for (const auto& score : golden.scores) {
    const std::string name = score.row.stage + " " + score.row.metric;
    if (!find_metric(score.row.stage, score.row.metric) && ++undeclared == 1) example = name;
    if (!std::isfinite(score.first) || !std::isfinite(score.row.value) || score.tolerance <= 0) continue;
    const double crept = (worsening(score.row, score.first, score.row.value) - score.known_drift) / score.tolerance;
    if (crept > kCreepNotice * kCreepTolerances)
      found.note(golden.name,
                 fmt::format("{} crept from {:.6g} to {:.6g} over its accepts, {:.1f} tolerances; the alarm is "
                             "at {:g}",
                             name, score.first, score.row.value, crept, kCreepTolerances));
  }
  if (undeclared > 0)
    found.grave(golden.name,
                fmt::format("{} numbers that no metric declares, e.g. {}: obsolete, accept anew", undeclared, example));
  for (const auto& [name, reason] : golden.known_misses) {
    const auto at = name.find(' ');
    const Metric* metric = at == std::string::npos ? nullptr : find_metric(name.substr(0, at), name.substr(at + 1));
    if (!metric || !metric->target)
      found.grave(golden.name, "known miss of \"" + name + "\", which has no target: stale, accept anew");
  }
}

void examine_case(const fs::path& golden, const GoldenCase& read, Examination& found) {
  const fs::path root = fs::absolute(golden).lexically_normal().parent_path();
  if (!fs::is_regular_file(root / read.scene))
    found.grave(read.name,
                "its scene " + read.scene + " is missing; expected it relative to the folder of the references");
  if (read.steps.empty()) found.note(read.name, "no bytes kept: accept to keep them");
  if (read.history.empty() || read.history.back().empty()) found.note(read.name, "its last accept gave no reason");
  for (const auto& [stem, drift] : read.image_drift)
    if (drift > kDriftNotice)
      found.note(read.name,
                 fmt::format("image {} came a way of FLIP {:.3f} over its accepts: look at it", stem, drift));
  std::set<std::string> known{"golden.json"};
  for (const auto& [stem, image] : read.images) known.insert(stem + ".png");
  for (const auto& entry : fs::directory_iterator(golden / read.name))
    if (const std::string file = entry.path().filename().string(); !known.count(file))
      found.note(read.name, "nobody reads " + file + ": expected golden.json and its images alone");
  examine_scores(read, found);
}

void examine_pictures(const std::vector<GoldenCase>& cases, Examination& found) {
  std::vector<std::pair<std::string, cv::Mat>> all;
  for (const auto& each : cases)
    for (const auto& [stem, image] : each.images) all.emplace_back(each.name + "/" + stem, image);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (!told_apart(all[i].second, all[j].second))
        found.grave("images",
                    all[i].first + " and " + all[j].first + " cannot be told apart: one would pass for the other");
}

void examine_nuisance(const fs::path& golden, const std::vector<GoldenCase>& cases, Examination& found) {
  const auto nuisance = read_nuisance(golden);
  if (!nuisance) {
    found.note("nuisance.json",
               "missing: tolerances are declared, not measured; `dressform gate nuisance` measures them");
    return;
  }
  if (nuisance->distinct() < kEnoughPlaces)
    found.note("nuisance.json",
               fmt::format("{} environments with bytes of their own; at least {} tell something{}",
                           nuisance->distinct(), kEnoughPlaces, nuisance->usable() ? "" : ", and so few are not used"));
  const auto left_out = leave_one_out(*nuisance);
  int alarmed = 0;
  for (const auto& place : left_out) {
    alarmed += !place.alarms.empty();
    if (!place.alarms.empty())
      found.note("nuisance.json", fmt::format("left out, {} would have been alarmed by {} metrics, e.g. {}", place.name,
                                              place.alarms.size(), place.alarms.front()));
  }
  found.note("nuisance.json",
             fmt::format("{} of {} environments alarmed when left out: at most {:.0f} % of others, 95 % sure", alarmed,
                         left_out.size(), 100 * alarm_rate_bound(alarmed, static_cast<int>(left_out.size()))));
  std::set<std::string> unmeasured;
  for (const auto& each : cases)
    for (const auto& score : each.scores)
      if (score.row.status == "ok" && !nuisance->tolerance(score.row))
        unmeasured.insert(score.row.stage + " " + score.row.metric);
  if (!unmeasured.empty())
    found.note("nuisance.json", fmt::format("{} numbers have no measured nuisance, e.g. {}: theirs is declared",
                                            unmeasured.size(), *unmeasured.begin()));
}

}  // namespace

std::vector<Complaint> examine_goldens(const fs::path& golden) {
  Examination found;
  std::vector<GoldenCase> cases;
  try {
    for (const auto& name : golden_case_names(golden)) {
      try {
        cases.push_back(read_golden_case(golden, name));
      } catch (const GoldenError& error) {
        found.grave(name, error.what());
      }
    }
    for (const auto& each : cases) examine_case(golden, each, found);
    examine_pictures(cases, found);
    examine_nuisance(golden, cases, found);
  } catch (const GoldenError& error) {
    found.grave(golden.string(), error.what());
  }
  return found.take();
}

}  // namespace dressform
