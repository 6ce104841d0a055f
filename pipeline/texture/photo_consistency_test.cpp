#include "pipeline/texture/photo_consistency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/texture/garment_views.h"
#include "pipeline/texture/textured_tube.h"

namespace dressform {
namespace {

// Waves in both directions, longer than any step that is to be found.
cv::Vec3f waves(double turn, double height) {
  const auto level = static_cast<float>(125 + 50 * std::sin(12 * turn) + 50 * std::sin(height / 0.015));
  return {level, level, level};
}

GarmentViews views_of(const TubeScene& scene) {
  return garment_views(scene.session, scene.calibration, scene.naked, scene.registration, scene.filled, scene.opened,
                       as_photographed())
      .at("top");
}

TEST(PhotoConsistent, AViewThatWasRegisteredWrongMovesBack) {
  const TubeScene right = tube_scene(waves, 0.25);
  TubeScene wrong = right;
  wrong.registration.model_from_sensor["k2"].pretranslate(Vector3d(0, 0.010, 0));
  const PhotoConsistencyParams params;
  const GarmentViews before = views_of(wrong);
  const double should = color_spread(*before.mesh, views_of(right).views, before.samples, params);
  const double spread = color_spread(*before.mesh, before.views, before.samples, params);
  ASSERT_GT(spread, 1.5 * should);  // oblique pixels blur the waves
  const auto views = photo_consistent(*before.mesh, before.views, before.samples, params);
  EXPECT_LT(color_spread(*before.mesh, views, before.samples, params), should + 0.25 * (spread - should));
}

TEST(PhotoConsistent, PlainClothMovesNothing) {
  const GarmentViews garment = views_of(tube_scene([](double, double) { return cv::Vec3f(90, 90, 90); }, 0.2));
  const auto views = photo_consistent(*garment.mesh, garment.views, garment.samples, {});
  for (std::size_t i = 0; i < views.size(); ++i)
    EXPECT_LT((views[i].eye - garment.views[i].eye).norm(), 0.001) << views[i].sensor;
  EXPECT_TRUE(photo_consistent(*garment.mesh, {}, {}, {}).empty());
  EXPECT_EQ(color_spread(*garment.mesh, {}, {}, {}), 0);
}

}  // namespace
}  // namespace dressform
