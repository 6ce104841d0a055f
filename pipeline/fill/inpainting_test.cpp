#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/fill/fill.h"
#include "pipeline/fill/garment_inpaint.h"
#include "pipeline/testing/analytic_scene.h"

namespace dressform {
namespace {

// Cloth on the left, an arm of another colour on the right, a hole between the two that touches both.
TEST(InpaintedFrom, LooksAtWhatIsInsideAlone) {
  cv::Mat bgr(40, 60, CV_8UC3, cv::Scalar(10, 20, 200)), hole = cv::Mat::zeros(40, 60, CV_8U), inside = hole.clone();
  bgr.colRange(0, 30).setTo(cv::Scalar(200, 100, 50));
  hole(cv::Rect(25, 10, 10, 20)) = 255;
  inside.colRange(0, 25).setTo(255);
  int asked = 0;
  const auto mean_color = [&](const cv::Mat& image, const cv::Mat& unknown) {
    ++asked;
    cv::Mat filled = image.clone();
    filled.setTo(cv::mean(image, unknown == 0), unknown);
    return filled;
  };
  const cv::Mat filled = inpainted_from(bgr, hole, inside, 8, mean_color);
  EXPECT_EQ(cv::mean(filled, hole), cv::Scalar(200, 100, 50));
  cv::Mat changed;
  cv::absdiff(filled, bgr, changed);
  changed.setTo(0, hole);
  EXPECT_EQ(cv::norm(changed, cv::NORM_INF), 0);
  EXPECT_EQ(asked, 1);
  const cv::Mat nothing = cv::Mat::zeros(40, 60, CV_8U);
  EXPECT_EQ(cv::norm(inpainted_from(bgr, hole, nothing, 8, mean_color), bgr, cv::NORM_INF), 0);
  EXPECT_EQ(asked, 1) << "nothing to take colours from";
}

// A shirt of level stripes, arms before it at the sides.
struct Striped {
  analytic::AnalyticScene scene;
  Segmentation truth;
  FilledViews fill(const char* variant) const {
    return Fill::at(variant).run(scene.session, scene.calibration, scene.body, scene.registration, truth, {}, 1);
  }
};
const Striped& striped() {
  static const Striped made = [] {
    analytic::SceneOptions options;
    options.top_color = [](const Vector3d& p) {
      return std::fmod(p.y() + 9, 0.08) < 0.04 ? cv::Vec3b(160, 60, 30) : cv::Vec3b(60, 150, 60);
    };
    Striped striped{analytic::make_scene(options), {}};
    striped.truth.labels = striped.scene.labels;
    striped.truth.garments["top"].kind = "shirt";
    return striped;
  }();
  return made;
}

// Each of the three leaves nothing black and nothing of the arm: every filled pixel is nearer to the shirt's colours,
// or a mixture of them, than to skin.
class EveryInpainting : public testing::TestWithParam<const char*> {};

TEST_P(EveryInpainting, FillsWithTheShirtsOwnColours) {
  const FilledViews filled = striped().fill(GetParam());
  int count = 0, skin = 0, black = 0;
  for (const char* sensor : {"k2", "k4"}) {
    const FilledGarment& top = filled.garments.at("top").at(sensor);
    for (int y = 0; y < top.mask.rows; ++y)
      for (int x = 0; x < top.mask.cols; ++x) {
        if (top.mask.at<uchar>(y, x) != 128) continue;
        const auto& c = top.color.at<cv::Vec3b>(y, x);
        ++count;
        skin += c[2] > std::max(c[0], c[1]);  // of the three colours skin alone has most red
        black += std::max({c[0], c[1], c[2]}) < 20;
      }
  }
  EXPECT_GT(count, 100);
  EXPECT_LT(skin, 0.01 * count);
  EXPECT_EQ(black, 0);
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryInpainting, testing::Values("telea", "navier_stokes", "shiftmap"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace dressform
