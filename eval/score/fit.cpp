#include "eval/metrics/fit_metrics.h"
#include "eval/metrics/girths.h"
#include "eval/score/metric_family.h"

namespace dressform {
namespace {
using namespace metrics;

void judge_fit(const Judged& run, StageRows& rows);

const MetricFamily fit_metrics{
    "fit",
    "fit",
    {{"<body>/girth_<tape>_error_mm", 2, "mm", Better::near_zero,
      "Tape girth of the estimated minus that of the true body."},
     Metric{"<slot>/ease_<tape>_change_mm", 3, "mm", Better::near_zero,
            "ease_fitted minus ease: how much looser the garment became on the user."}
         .with_target(15, 1.0)
         .with_headline("ease change, <tape>"),
     {"<slot>/ease_<tape>_mm", 3, "mm", Better::neither,
      "Garment girth minus body girth on the mannequin; absent where the garment does not go round the body."},
     {"<slot>/ease_<tape>_fitted_mm", 3, "mm", Better::neither, "The same on the user."},
     Metric{"<slot>/edge_stretch_p95", 1, "1", Better::lower,
            "95th percentile of abs(length fitted / length before - 1) over the edges."}
         .with_headline("edge stretch p95")},
    judge_fit};

struct TapeName {
  const char* name;
  TapeLevels::Level TapeLevels::*level;
};
const TapeName kTapes[] = {{"chest", &TapeLevels::chest}, {"waist", &TapeLevels::waist}, {"hip", &TapeLevels::hip}};

std::optional<TapeLevels> levels_of(const Mesh& body) {
  if (body.triangles.empty()) return {};
  return tape_levels(body);
}

void without_ease(StageRows& rows, const StageRows::Members& members, const std::string& status) {
  for (const char* metric : {"<slot>/ease_<tape>_mm", "<slot>/ease_<tape>_fitted_mm", "<slot>/ease_<tape>_change_mm"})
    rows.without_value(metric, members, status);
}

void add_ease(StageRows& rows, const std::string& slot, const GarmentOutput* garment,
              const std::optional<TapeLevels>& naked, const std::optional<TapeLevels>& user) {
  for (const auto& tape : kTapes) {
    const StageRows::Members members{slot, tape.name};
    if (!garment || !naked || !user) {
      without_ease(rows, members, "failed");
      continue;
    }
    const auto before = garment_girth_m(garment->mesh, (*naked).*tape.level);
    const auto after = garment_girth_m(garment->fitted, (*user).*tape.level);
    if (!before || !after) {  // the garment does not go round the body there
      without_ease(rows, members, "absent");
      continue;
    }
    const double ease = (*before - ((*naked).*tape.level).girth_m) * 1000;
    const double fitted = (*after - ((*user).*tape.level).girth_m) * 1000;
    rows.add("<slot>/ease_<tape>_mm", members, ease);
    rows.add("<slot>/ease_<tape>_fitted_mm", members, fitted);
    rows.add("<slot>/ease_<tape>_change_mm", members, fitted - ease);
  }
}

void add_girths(StageRows& rows, const std::string& body, const std::optional<TapeLevels>& levels,
                const std::optional<TapeLevels>& truth) {
  for (const auto& tape : kTapes) {
    const std::string metric = "<body>/girth_<tape>_error_mm";
    if (!truth)
      rows.absent(metric, {body, tape.name});
    else if (!levels)
      rows.fail(metric, {body, tape.name});
    else
      rows.add(metric, {body, tape.name}, (((*levels).*tape.level).girth_m - ((*truth).*tape.level).girth_m) * 1000);
  }
}

void judge_fit(const Judged& run, StageRows& rows) {
  const auto naked = levels_of(run.outputs.naked_body), user = levels_of(run.outputs.user_body);
  add_girths(rows, "naked_body", naked, levels_of(run.truth.naked_body));
  add_girths(rows, "user_body", user, levels_of(run.truth.user_body));
  for (const auto& slot : judged_slots(run)) {
    const GarmentOutput* garment = fitted_garment_of(run.outputs, slot);
    add_ease(rows, slot, garment, naked, user);
    if (garment && garment->mesh.triangles == garment->fitted.triangles)
      rows.add("<slot>/edge_stretch_p95", {slot}, edge_stretch_p95(garment->mesh, garment->fitted),
               static_cast<long>(garment->mesh.triangles.size()));
    else
      rows.fail("<slot>/edge_stretch_p95", {slot});
  }
}

}  // namespace
}  // namespace dressform
