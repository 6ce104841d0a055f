#include "eval/gate/power/power_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "eval/studies/statistics.h"

namespace dressform {
namespace {

constexpr double kFoundPart = 0.95;  // of the placements: what counts as found

bool had_effect(const PowerCell& cell) { return cell.crashed || !cell.by_bytes.empty(); }

bool found_enough(const Detection& size) { return size.placed > 0 && size.found >= kFoundPart * size.placed; }

void add_blame(BlameMatrix& matrix, const std::string& step, const std::string& blamed, bool right) {
  ++matrix.counts[step][blamed.empty() ? "none" : blamed];
  ++matrix.total;
  matrix.right += right;
}

// Steps and stages in the order of a run, pictures last.
std::vector<std::string> in_order(const std::set<std::string>& names) {
  const std::vector<std::string> order = {
      "capture",   "calibrate",       "multipath", "fuse",    "fuse_naked", "extract", "registration",
      "landmarks", "landmarks_naked", "segment",   "fill",    "surface",    "open",    "texture",
      "fuse_user", "landmarks_user",  "fit",       "correct", "out",        "scores",  "image",
      "none"};
  std::vector<std::string> result(names.begin(), names.end());
  const auto place = [&](const std::string& name) {
    return std::find(order.begin(), order.end(), name) - order.begin();
  };
  std::stable_sort(result.begin(), result.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return result;
}

}  // namespace

std::vector<DetectionCurve> detection_curves(const std::vector<Fault>& faults, const std::vector<PowerCell>& cells) {
  std::vector<DetectionCurve> curves;
  for (const auto& fault : faults) {
    DetectionCurve curve{fault, {}, 0, {}};
    for (std::size_t k = 0; k < fault.sizes.size(); ++k) {
      Detection size{k, 0, 0, 0};
      for (const auto& cell : cells) {
        if (cell.fault != fault.id() || cell.size != k) continue;
        curve.without_effect += !had_effect(cell);
        size.placed += had_effect(cell);
        size.found += had_effect(cell) && cell.found;
      }
      if (size.placed == 0) continue;
      size.at_least = wilson_interval(size.found, size.placed).low;
      curve.sizes.push_back(size);
    }
    for (auto it = curve.sizes.rbegin(); it != curve.sizes.rend() && found_enough(*it); ++it)
      curve.size_found = fault.sizes[it->size];
    curves.push_back(curve);
  }
  return curves;
}

BlameMatrix blame_by_bytes(const std::vector<PowerCell>& cells) {
  BlameMatrix matrix;
  for (const auto& cell : cells) {
    if (cell.crashed || !had_effect(cell)) continue;
    const std::string blamed = cell.by_bytes.rfind("image ", 0) == 0 ? "image" : cell.by_bytes;
    add_blame(matrix, cell.step, blamed, blamed == cell.step);
  }
  return matrix;
}

BlameMatrix blame_by_numbers(const std::vector<PowerCell>& cells, const Scores& scores) {
  BlameMatrix matrix;
  for (const auto& cell : cells)
    if (cell.found && !cell.crashed)
      add_blame(matrix, cell.step, cell.by_numbers, blamed_right_by_numbers(cell, scores));
  return matrix;
}

std::string curves_text(const std::vector<DetectionCurve>& curves) {
  std::string text =
      fmt::format("{:<34} {:<7} {}\n", "fault", "unit", "size: found of placed (at least) ... size found");
  std::map<std::string, std::pair<int, int>> by_word;  // found, placed
  std::string missed;
  for (const auto& curve : curves) {
    text += fmt::format("{:<34} {:<7}", curve.fault.id(), curve.fault.unit);
    for (const auto& size : curve.sizes) {
      const std::string word = size_word(curve.fault, size.size);
      text += fmt::format(" {:>5g}: {}/{} ({:.0f} %)", curve.fault.sizes[size.size], size.found, size.placed,
                          100 * size.at_least);
      by_word[word].first += size.found;
      by_word[word].second += size.placed;
      if (word == "large" && size.found < size.placed)
        missed += fmt::format("  {} of {:g} {}: {} of {}\n", curve.fault.id(), curve.fault.sizes[size.size],
                              curve.fault.unit, size.found, size.placed);
    }
    text += curve.size_found      ? fmt::format("  from {:g} {}", *curve.size_found, curve.fault.unit)
            : curve.sizes.empty() ? "  no effect anywhere"
                                  : "  NOT FOUND";
    if (curve.without_effect > 0) text += fmt::format("; {} placements had no effect", curve.without_effect);
    text += "\n";
  }
  for (const char* word : {"large", "medium", "small"})
    if (const auto [found, placed] = by_word[word]; placed > 0)
      text += fmt::format("{}: {} of {} found, at least {:.0f} % with 95 % confidence\n", word, found, placed,
                          100 * wilson_interval(found, placed).low);
  if (!missed.empty()) text += "large ones that were missed:\n" + missed;
  return text;
}

std::string blame_text(const BlameMatrix& matrix, const std::string& title) {
  if (matrix.total == 0) return title + ": nothing to blame\n";
  std::set<std::string> steps, blamed;
  for (const auto& [step, row] : matrix.counts) {
    steps.insert(step);
    for (const auto& [name, count] : row) blamed.insert(name);
  }
  const auto columns = in_order(blamed);
  std::string text = fmt::format("{}: right in {} of {} ({:.0f} %)\n{:<17}", title, matrix.right, matrix.total,
                                 100.0 * matrix.right / matrix.total, "fault in");
  for (const auto& name : columns) text += fmt::format(" {:>6.6}", name);
  text += "\n";
  for (const auto& step : in_order(steps)) {
    text += fmt::format("{:<17}", step);
    const auto& row = matrix.counts.at(step);
    for (const auto& name : columns) {
      const auto count = row.find(name);
      text += fmt::format(" {:>6}", count == row.end() ? std::string(".") : std::to_string(count->second));
    }
    text += "\n";
  }
  return text;
}

}  // namespace dressform
