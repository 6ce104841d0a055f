#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "pipeline/fill/random_paint.h"
#include "scenes/error.h"
#include "scenes/picks.h"

namespace dressform {
namespace {

struct ThesisRandomParams {
  GarmentDepthParams depth;
  HoleParams holes;
  bool fill_depth = false;
};
template <class V>
void fields(V& v, ThesisRandomParams& p) {
  shared_fields(v, p.depth, p.holes);
  v("fill_depth", p.fill_depth,
    "make up depth for what an arm hides in a picked region; the thesis fills in colours alone");
}

cv::Mat paint(const std::vector<GarmentView>& views, std::size_t index, const Picks& picks, Seed seed) {
  const GarmentView& view = views[index];
  const std::string garment = view.label == Label::top ? "top" : "bottom";
  const std::string name = "smooth_" + garment + "_" + view.sensor;
  const cv::Mat lends = picked_region(picks, name, view.garment.color.size());
  if (lends.empty() || cv::countNonZero(lends) == 0)
    throw InputError("picks/" + name, fmt::format("found {}; expected the smooth block of cloth (31 x 31 pixels in the "
                                                  "thesis) that lends its colours to picks/region_{}_{}",
                                                  lends.empty() ? "none" : "no pixel inside", garment, view.sensor));
  return painted_at_random(view.garment, lends, paint_stream(views, index), seed);
}

// Thesis, section 3.2.2: in the region that a person marks, each pixel takes the colour of a random pixel of the smooth
// block that the person picked: region_<garment>_<sensor> and smooth_<garment>_<sensor>.
FilledViews thesis_random31(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                            const Registration& registration, const Segmentation& segmentation,
                            const ThesisRandomParams& params, const Picks& picks, Seed seed) {
  const PickedHoles holes{[&](const std::string& slot, const std::string& sensor) {
                            const Camera& camera = calibration.sensors.at(sensor).color.value();
                            return picked_region(picks, "region_" + slot + "_" + sensor, {camera.width, camera.height});
                          },
                          params.fill_depth};
  return fill_views(
      session, calibration, naked, registration, segmentation, params.depth, params.holes,
      [&](const std::vector<GarmentView>& views, std::size_t k) { return paint(views, k, picks, seed); }, &holes);
}

const Fill::Variant thesis_random31_variant{"thesis_random31", thesis_random31, {"region_*", "smooth_*"}};

}  // namespace
}  // namespace dressform
