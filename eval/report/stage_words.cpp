#include "eval/report/stage_words.h"

#include <fmt/format.h>

#include <functional>
#include <map>

#include "eval/run/garments_json.h"

namespace dressform {
namespace {

std::string of_capture(const Reconstruction& made) {
  const auto sentence = [](const std::string& images, const BounceStrength& strength) {
    return strength.images == 0
               ? ""
               : fmt::format("Bounced light in {}: the floor shows {:.2f} +- {:.2f} of what is predicted, {}. ", images,
                             strength.measured, strength.sigma, strength.factor > 0 ? "taken off" : "left alone");
  };
  const Multipath& multipath = made.multipath.get();
  std::string text = sentence("the shots", multipath.shots);
  for (const auto& [name, strength] : multipath.scans) text += sentence(name, strength);
  if (!multipath.infrared_scaled) text += "Infrared images are of an unknown scale and were not used. ";
  return text;
}

std::string of_scan(const BodyModel& model) {
  return fmt::format("{} frames, loop closed to {:.1f} mm, residual {:.1f} mm, {}; {} vertices, {} triangles.{}",
                     model.frames_used, 1000 * model.loop_closure_m, 1000 * model.residual_rms_m,
                     model.converged ? "converged" : "NOT converged", model.body.vertices.size(),
                     model.body.triangles.size(), model.note.empty() ? "" : " " + model.note + ".");
}

std::string of_extract(const Reconstruction& made) {
  std::string text;
  for (const auto& [sensor, view] : made.extracted.get().views)
    if (!view.found_naked || !view.found_dressed)
      text += fmt::format("{}: mannequin NOT found {}. ", sensor,
                          view.found_naked     ? "in the dressed shot"
                          : view.found_dressed ? "in the naked shot"
                                               : "in either shot");
  return text.empty() ? "The mannequin was found in every shot." : text;
}

std::string why_not(const Registration& registration, const std::string& sensor) {
  const auto found = registration.problem.find(sensor);
  return found == registration.problem.end() ? "" : " (" + found->second + ")";
}

std::string of_registration(const Reconstruction& made) {
  std::string text;
  const auto& registration = made.registration.get();
  for (const auto& [sensor, converged] : registration.converged)
    text += !converged ? fmt::format("{}: NOT converged{}. ", sensor, why_not(registration, sensor))
                       : fmt::format("{}: residual {:.1f} mm on {} points. ", sensor,
                                     1000 * registration.residual_rms_m.at(sensor), registration.inliers.at(sensor));
  return text;
}

std::string of_landmarks(const Landmarks& marks) {
  const char* sources[] = {"nothing", "the feet", "the rig's prior", "likeness to the mannequin"};
  return fmt::format("Front told by {}{}; crotch {:.0f}, waist {:.0f}, armpit {:.0f}, neck {:.0f} mm over the floor.",
                     sources[static_cast<int>(marks.front_from)], marks.sure ? "" : ", NOT sure",
                     1000 * (marks.crotch_y - marks.floor_y), 1000 * (marks.waist_y - marks.floor_y),
                     1000 * (marks.armpit_y - marks.floor_y), 1000 * (marks.neck_y - marks.floor_y));
}

// A sentence for each garment of a stage; "No garment." without any.
template <class Garments, class Sentence>
std::string of_garments(const Garments& garments, const Sentence& sentence) {
  std::string text;
  for (const auto& [slot, garment] : garments) text += sentence(slot, garment) + " ";
  return text.empty() ? "No garment." : text;
}

std::string of_surface(const Reconstruction& made) {
  return of_garments(made.closed.get().garments, [](const std::string& slot, const ClosedGarment& garment) {
    return fmt::format("{}: {} triangles from {} points.", slot, garment.mesh.triangles.size(),
                       garment.support.points.size());
  });
}

std::string unseen_words(const Rim& rim) {
  if (!rim.observed) return " (seen by no view)";
  const double part = rim.unseen_part();
  return part > 0 ? fmt::format(" ({:.0f} % seen by no view)", 100 * part) : "";
}

std::string of_open(const Reconstruction& made) {
  std::string text = of_garments(made.opened.get().garments, [](const std::string& slot, const OpenGarment& garment) {
    std::string rims;
    for (const auto& rim : garment.rims) rims += (rims.empty() ? "" : ", ") + rim.name + unseen_words(rim);
    return word_of(slot, garment.layout) + " Rims: " + rims + ".";
  });
  for (const auto& [slot, why] : made.opened.get().failed) text += fmt::format("{}: NOT opened, {}. ", slot, why);
  return text;
}

std::string of_texture(const Reconstruction& made) {
  return of_garments(made.textured.get().unseen_part, [](const std::string& slot, double part) {
    return fmt::format("{}: {:.1f} % of the area got its colour from no view.", slot, 100 * part);
  });
}

std::string of_fit(const Reconstruction& made) {
  return fmt::format("{} control points; deformed mannequin to user {:.1f} mm rms; {} folded triangles.",
                     made.fitted->get().control_points, 1000 * made.fitted->get().body_rms_m,
                     made.fitted->get().foldovers);
}

std::string of_correct(const Reconstruction& made) {
  const auto& corrected = made.corrected->get();
  return of_garments(corrected.moved_vertices, [&](const std::string& slot, int moved) {
    const auto converged = corrected.converged.find(slot);
    return fmt::format("{}: {} vertices moved{}.", slot, moved,
                       converged != corrected.converged.end() && !converged->second ? ", it STILL cuts the body" : "");
  });
}

}  // namespace

std::string stage_words(const Reconstruction& made, const std::string& label) {
  static const std::map<std::string, std::function<std::string(const Reconstruction&)>> words{
      {"capture", of_capture},
      {"fuse_naked", [](const Reconstruction& r) { return of_scan(r.naked.get()); }},
      {"fuse_user", [](const Reconstruction& r) { return of_scan(r.user->get()); }},
      {"landmarks_naked", [](const Reconstruction& r) { return of_landmarks(r.landmarks.get()); }},
      {"extract", of_extract},
      {"registration", of_registration},
      {"surface", of_surface},
      {"open", of_open},
      {"texture", of_texture},
      {"fit", of_fit},
      {"correct", of_correct}};
  const auto found = words.find(label);
  return found == words.end() ? std::string() : found->second(made);
}

}  // namespace dressform
