#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "synthetic/sensors/sensor_model.h"

namespace dressform {
namespace {

struct IdealParams {
  double minimum_m = 0.5, maximum_m = 4.5;
};

template <class V>
void fields(V& v, IdealParams& p) {
  v("minimum_m", p.minimum_m, 0.0, 2.0, "m", "nearest depth that is measured");
  v("maximum_m", p.maximum_m, 1.0, 30.0, "m", "farthest depth that is measured");
}

// Exact depth along the axis, rounded to millimetres; no noise, no mixed pixels, chrome measured like cloth.
SensorFrame ideal(const IrView& view, const IdealParams& params) {
  const std::vector<IrSample> samples = view.first_hits();
  SensorFrame frame{cv::Mat(view.height(), view.width(), CV_16UC1), cv::Mat(view.height(), view.width(), CV_16UC1)};
  tbb::parallel_for(0, view.height(), [&](int y) {
    for (int x = 0; x < view.width(); ++x) {
      const IrSample& sample = samples[static_cast<std::size_t>(y) * view.width() + x];
      const float cos_axis = sample.depth_m > 0 ? sample.depth_m / sample.distance_m : 1.0f;
      frame.depth_mm.at<std::uint16_t>(y, x) =
          depth_in_mm(sample.depth_m, view.depth_offset_m(), params.minimum_m, params.maximum_m);
      frame.ir.at<std::uint16_t>(y, x) = cv::saturate_cast<std::uint16_t>(ir_counts(sample, cos_axis));
    }
  });
  return frame;
}

const SensorModel::Variant ideal_variant{"ideal", ideal};

}  // namespace
}  // namespace dressform
