#include "eval/run/stage_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "scenes/label.h"

namespace dressform {
namespace {

using Slots = std::set<std::string>;

template <class Garments>
Slots slots_of(const Garments& garments) {
  Slots slots;
  for (const auto& [slot, garment] : garments) slots.insert(slot);
  return slots;
}

// The garments of a stage that have a surface.
template <class Garments, class Mesher>
Slots with_surface(const Garments& garments, const Mesher& mesh_of) {
  Slots slots;
  for (const auto& [slot, garment] : garments)
    if (!mesh_of(garment).triangles.empty()) slots.insert(slot);
  return slots;
}

// Slots that the label images show in some view.
Slots labelled_slots(const Segmentation& segmentation) {
  Slots slots;
  for (const auto& [sensor, labels] : segmentation.labels)
    for (const auto& [slot, label] : {std::pair("top", Label::top), std::pair("bottom", Label::bottom)})
      if (!slots.count(slot) && cv::countNonZero(labels == static_cast<int>(label)) > 0) slots.insert(slot);
  return slots;
}

class Problems {
 public:
  explicit Problems(const Reconstruction& made) : made_(made) {}

  std::vector<StageProblem> all() {
    calibration();
    scan("fuse_naked", made_.naked.get());
    extraction();
    registration();
    garments();
    if (made_.user) user();
    return std::move(problems_);
  }

 private:
  void add(const std::string& stage, const std::string& what) { problems_.push_back({stage, what, false, {}}); }

  void calibration() {
    for (const auto& [sensor, report] : made_.calibrated.get().boards)
      if (!report.converged)
        add("calibrate", fmt::format("{} did not converge on its boards: {} of {} shots used in infrared, {} in colour",
                                     sensor, report.used_ir, report.shots, report.used_color));
  }

  void scan(const std::string& stage, const BodyModel& model) {
    if (model.body.triangles.empty())
      add(stage, fmt::format("made no body from {} frames", model.frames_used));
    else if (!model.converged)
      add(stage, fmt::format("did not converge: {} frames used, loop closed to {:.1f} mm, residual {:.1f} mm",
                             model.frames_used, 1000 * model.loop_closure_m, 1000 * model.residual_rms_m));
  }

  void extraction() {
    const auto& views = made_.extracted.get().views;
    for (const auto& sensor : made_.sensors) {
      const auto found = views.find(sensor);
      if (found == views.end() || !found->second.found_naked)
        add("extract", "found no mannequin in " + sensor + "'s shot of the naked one");
      if (found == views.end() || !found->second.found_dressed)
        add("extract", "found no mannequin in " + sensor + "'s shot of the dressed one");
    }
  }

  void registration() {
    const auto& registration = made_.registration.get();
    for (const auto& sensor : made_.sensors) {
      const auto converged = registration.converged.find(sensor);
      if (converged != registration.converged.end() && converged->second) continue;
      const auto problem = registration.problem.find(sensor);
      const auto inliers = registration.inliers.find(sensor);
      const std::string why = problem != registration.problem.end()   ? problem->second
                              : inliers == registration.inliers.end() ? "nothing to register it by"
                                                                      : "did not converge";
      add("registration", fmt::format("{} was not registered: {}", sensor, why));
    }
  }

  // From the label images to the textured meshes: what each stage got and did not hand on.
  void garments() {
    const Slots labelled = labelled_slots(made_.segmentation.get());
    if (labelled.empty())
      problems_.push_back(
          {"segment", fmt::format("found no garment in {} registered views", registered_views()), true, {}});
    const Slots filled = slots_of(made_.filled.get().garments);
    handed_on("fill", labelled, filled, "was cut out of no view");
    const auto mesh_of = [](const auto& garment) -> const Mesh& { return garment.mesh; };
    const Slots closed = with_surface(made_.closed.get().garments, mesh_of);
    handed_on("surface", filled, closed, "got no surface: its points close none");
    const Slots opened = with_surface(made_.opened.get().garments, mesh_of);
    handed_on("open", closed, opened, "was not cut open", made_.opened.get().failed);
    made_garments_ = with_surface(made_.textured.get().garments, mesh_of);
    handed_on("texture", opened, made_garments_, "got no texture");
  }

  void user() {
    scan("fuse_user", made_.user->get());
    const auto mesh_of = [](const auto& garment) -> const Mesh& { return garment.mesh; };
    const Slots fitted = with_surface(made_.fitted->get().garments, mesh_of);
    handed_on("fit", made_garments_, fitted,
              fmt::format("was not moved to the user: {} control points", made_.fitted->get().control_points));
    const auto& corrected = made_.corrected->get();
    handed_on("correct", fitted, with_surface(corrected.garments, mesh_of), "was lost");
    for (const auto& [slot, converged] : corrected.converged) {
      const auto pairs = corrected.intersecting_pairs.find(slot);
      if (!converged)
        add("correct", fmt::format("the {} still cuts the body{}", slot,
                                   pairs == corrected.intersecting_pairs.end()
                                       ? ""
                                       : fmt::format(" in {} pairs of triangles", pairs->second)));
    }
  }

  // `reasons`: the stage's own, by slot.
  void handed_on(const std::string& stage, const Slots& before, const Slots& after, const std::string& what,
                 const std::map<std::string, std::string>& reasons = {}) {
    for (const auto& slot : before) {
      if (after.count(slot)) continue;
      const auto reason = reasons.find(slot);
      problems_.push_back(
          {stage, "the " + slot + " " + what + (reason == reasons.end() ? "" : ": " + reason->second), true, slot});
    }
  }

  int registered_views() const {
    int count = 0;
    for (const auto& [sensor, converged] : made_.registration.get().converged) count += converged;
    return count;
  }

  const Reconstruction& made_;
  Slots made_garments_;
  std::vector<StageProblem> problems_;
};

}  // namespace

std::vector<StageProblem> stage_problems(const Reconstruction& made) { return Problems(made).all(); }

std::vector<StageProblem> with_unfound_garments(std::vector<StageProblem> problems, const Reconstruction& made,
                                                const std::vector<std::string>& worn) {
  Slots known = slots_of(made.textured.get().garments);
  for (const auto& problem : problems) {
    if (problem.garment_missing && problem.slot.empty()) return problems;
    known.insert(problem.slot);
  }
  for (const auto& slot : worn)
    if (!known.count(slot))
      problems.push_back({"segment", "did not find the " + slot + " that the ground truth knows", true, slot});
  return problems;
}

bool garments_missing(const std::vector<StageProblem>& problems) {
  return std::any_of(problems.begin(), problems.end(), [](const auto& each) { return each.garment_missing; });
}

nlohmann::json to_json(const std::vector<StageProblem>& problems) {
  auto rows = nlohmann::json::array();
  for (const auto& problem : problems)
    rows.push_back({{"stage", problem.stage},
                    {"what", problem.what},
                    {"garment_missing", problem.garment_missing},
                    {"slot", problem.slot}});
  return rows;
}

std::vector<StageProblem> problems_from_json(const nlohmann::json& rows) {
  std::vector<StageProblem> problems;
  for (const auto& row : rows)
    problems.push_back({row.at("stage").get<std::string>(), row.at("what").get<std::string>(),
                        row.at("garment_missing").get<bool>(), row.at("slot").get<std::string>()});
  return problems;
}

}  // namespace dressform
