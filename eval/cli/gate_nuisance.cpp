// `dressform gate nuisance`: the cases run by this program and by others, in environments of their own.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "eval/cli/gate_options.h"
#include "eval/gate/nuisance.h"
#include "eval/run/child_process.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A command without the folders of its words: what is kept says nothing of a machine's paths.
std::string without_folders(const std::string& start) {
  std::istringstream words(start);
  std::string text;
  for (std::string word; words >> word;) {
    const auto slash = word.rfind('/');
    text += (text.empty() ? "" : " ") + (slash == std::string::npos ? word : word.substr(slash + 1));
  }
  return text;
}

// Runs the cases with a program in a folder of its own (stores are not shared: what one environment made must not pass
// for another's), and reads back what they showed.
PlaceRuns run_place(const std::string& start, const std::vector<std::string>& cases, const GateOptions& options,
                    const fs::path& work, int threads) {
  fs::remove_all(work);  // what an earlier program made here must not pass for this one's
  fs::create_directories(work);
  std::string line =
      fmt::format("{} gate run --golden {} --work {} --threads {} -q", start,
                  shell_word(fs::absolute(options.golden).string()), shell_word(fs::absolute(work).string()), threads);
  for (const auto& name : cases) line += " " + shell_word(name);
  const ChildResult result =
      run_child({line, fs::current_path(), 60 * options.limit_minutes, work / "stdout.txt", work / "stderr.txt"});
  if (!result.good())
    throw InputError("--run-with " + start,
                     fmt::format("ended with {}; expected a program that knows `gate run`{}", result.end_text(),
                                 result.complaint.empty() ? "" : ": " + result.complaint));
  PlaceRuns place{without_folders(start), {}};
  for (const auto& name : cases) place.runs[name] = read_golden_run(observed_folder(work, name));
  return place;
}

void print_nuisance(const MeasuredNuisance& nuisance) {
  for (const auto& place : nuisance.places)
    fmt::print("{}: {}\n", place.name,
               place.changed_steps ? fmt::format("{} steps have other bytes", place.changed_steps)
                                   : "the bytes of the reference");
  std::vector<std::pair<double, std::string>> moved;
  for (const auto& [name, distances] : nuisance.metrics)
    if (const double most = *std::max_element(distances.begin(), distances.end()); most > 0)
      moved.push_back({most, name});
  std::sort(moved.rbegin(), moved.rend());
  fmt::print("{} of {} metrics moved\n", moved.size(), nuisance.metrics.size());
  for (const auto& [most, name] : moved) fmt::print("  {:<12.4g} {}\n", most, name);
  for (const auto& [name, distances] : nuisance.pictures)
    fmt::print("  {:<12.4g} image {}\n", *std::max_element(distances.begin(), distances.end()), name);
  for (const auto& change : nuisance.status_changes) fmt::print("  another status: {}\n", change);
  int alarmed = 0;
  const auto left_out = leave_one_out(nuisance);
  for (const auto& place : left_out) {
    alarmed += !place.alarms.empty();
    for (const auto& name : place.alarms) fmt::print("left out, {} would be alarmed by {}\n", place.name, name);
  }
  fmt::print("false alarms: {} of {} environments left out in turn; with 95 % confidence at most {:.0f} % of others\n",
             alarmed, left_out.size(), 100 * alarm_rate_bound(alarmed, static_cast<int>(left_out.size())));
  if (!nuisance.usable()) fmt::print("so few environments are not used: declared tolerances stay\n");
}

}  // namespace

int gate_nuisance(const GateOptions& options) {
  try {
    const auto cases = chosen_cases(options);
    const int threads = ThreadLimit(options.threads).count();
    std::vector<std::string> starts{shell_word(fs::read_symlink("/proc/self/exe").string())};
    starts.insert(starts.end(), options.run_with.begin(), options.run_with.end());
    std::vector<PlaceRuns> places;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      fmt::print(stderr, "{} of {}: {}\n", k + 1, starts.size(), starts[k]);
      places.push_back(
          run_place(starts[k], cases, options, options.work / "nuisance" / fmt::format("{:02}", k), threads));
      if (k == 0) places.back().name = "this program";
    }
    const MeasuredNuisance nuisance = measure_nuisance(places);
    print_nuisance(nuisance);
    if (!options.dry) write_nuisance(options.golden, nuisance);
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
  return kSuccess;
}

}  // namespace dressform
