#include "pipeline/run/picks_in_model.h"

#include <fnmatch.h>

#include <algorithm>

#include "scenes/hash.h"

namespace dressform {
namespace {

// Where a frame of picks stands in the model's frame or the user's; nothing where that is not known.
struct Placed {
  Isometry3d target_from_frame;
  const char* target;
};

std::optional<Isometry3d> first_pose(const BodyModel& body) {
  if (body.model_from_frame.empty() || !body.model_from_frame.front().matrix().allFinite()) return {};
  return body.model_from_frame.front();
}

std::optional<Placed> placed(const std::string& frame, const BodyModel& naked, const Registration& registration,
                             const BodyModel* user) {
  if (frame == "model" || frame == "user") return Placed{Isometry3d::Identity(), frame == "model" ? "model" : "user"};
  if (frame == "scan_naked") {
    const auto pose = first_pose(naked);
    return pose ? std::optional<Placed>({*pose, "model"}) : std::nullopt;
  }
  if (frame == "scan_user") {
    const auto pose = user ? first_pose(*user) : std::nullopt;
    return pose ? std::optional<Placed>({*pose, "user"}) : std::nullopt;
  }
  const auto view = registration.model_from_sensor.find(frame);
  if (view == registration.model_from_sensor.end()) return {};
  return Placed{view->second, "model"};
}

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

// How a person makes picks of that name, and from what.
std::string how_made(const std::string& pattern) {
  const auto begins = [&](const char* start) { return pattern.rfind(start, 0) == 0; };
  if (begins("rim_"))
    return "points in order round each rim: run the pipeline with another variant of this stage, open its "
           "out/top_closed.ply in MeshLab (PickPoints) and save them as picks/model/rim_top_neck.pp";
  if (begins("border_"))
    return "points in order along each border between two views: run the pipeline with another variant of this stage, "
           "open its out/top.ply in MeshLab (PickPoints) and save them as picks/model/border_top_front_left.pp";
  if (begins("control") || begins("target"))
    return "as many points on the mannequin as on the user, in the same order: run the pipeline with another variant "
           "of this stage, open its out/naked_body.ply and out/user_body.ply in MeshLab (PickPoints) and save them as "
           "picks/model/control.pp and picks/user/target.pp";
  return "outlines in the colour image of each sensor: open dressed/<sensor>/color.png of the session in labelme and "
         "save them as picks/<sensor>/color.json";
}

}  // namespace

Picks in_model_frame(const Picks& picks, const BodyModel& naked, const Registration& registration,
                     const BodyModel* user) {
  Picks result;
  result.regions = picks.regions;
  for (const auto& [name, parts] : picks.points)
    for (const auto& part : parts) {
      const auto place = placed(part.frame, naked, registration, user);
      if (!place) continue;
      PickedPoints moved{place->target, {}};
      for (const auto& point : part.points) moved.points.push_back(place->target_from_frame * point);
      result.points[name].push_back(std::move(moved));
    }
  return result;
}

LazyArtifact<Picks> in_model_frame(const LazyArtifact<Picks>& picks, const LazyArtifact<BodyModel>& naked,
                                   const LazyArtifact<Registration>& registration,
                                   const std::optional<LazyArtifact<BodyModel>>& user) {
  return {hash_hex(picks.content_hash() + "/" + naked.content_hash() + "/" + registration.content_hash() + "/" +
                   (user ? user->content_hash() : "")),
          [picks, naked, registration, user] {
            return in_model_frame(picks.get(), naked.get(), registration.get(), user ? &user->get() : nullptr);
          }};
}

void check_picks(const ReconstructionOptions& options, const SessionSource& source) {
  std::optional<std::vector<std::string>> names;
  for (const auto& stage : describe_stages()) {
    const auto chosen = options.variants.find(stage.name);
    const std::string variant = chosen == options.variants.end() ? stage.default_variant : chosen->second;
    for (const auto& described : stage.variants) {
      if (described.name != variant) continue;
      for (const auto& pattern : described.picks) {
        if (!names) names = source.picks ? source.picks->get().names() : std::vector<std::string>{};
        if (std::any_of(names->begin(), names->end(), [&](const auto& name) { return matches(pattern, name); }))
          continue;
        throw InputError("picks: " + pattern, "missing from the session, but " + stage.name + "=" + variant +
                                                  " needs it; expected " + how_made(pattern) +
                                                  " (scenes/README.md, \"Picks\")");
      }
    }
  }
}

}  // namespace dressform
