#include "eval/wardrobe/graded_body.h"

#include <gtest/gtest.h>

#include "scenes/error.h"
#include "synthetic/body/body.h"

namespace dressform {
namespace {

TEST(GradedBody, TheTapeReadsTheGirthsThatWereWanted) {
  const KnownBody body = known_body(make_body({}).mesh);
  const SizeClass size = size_chart("men")[3];
  const KnownBody graded = graded_body(body, {size.chest_m, size.waist_m, size.hip_m}, "the body");
  EXPECT_EQ(graded.body.triangles, body.body.triangles);
  EXPECT_NEAR(graded.landmarks.stature, body.landmarks.stature, 1e-9);
  EXPECT_TRUE(graded.landmarks.has_trunk);
  const BodyGirths found = girths_of(graded.body, "the body");
  EXPECT_NEAR(found.chest_m, size.chest_m, 0.01);  // the tape may find another level on another body
  EXPECT_NEAR(found.waist_m, size.waist_m, 0.01);
  EXPECT_NEAR(found.hip_m, size.hip_m, 0.01);
}

TEST(GradedBody, ItsOwnGirthsLeaveItAsItIs) {
  const KnownBody body = known_body(make_body({}).mesh);
  const KnownBody same = graded_body(body, girths_of(body.body, "the body"), "the body");
  for (std::size_t v = 0; v < body.body.vertices.size(); ++v)
    ASSERT_LT((same.body.vertices[v] - body.body.vertices[v]).norm(), 1e-9);
}

TEST(GradedBody, WhatIsNoBodyIsRefused) {
  EXPECT_THROW(girths_of({}, "nobody"), InputError);
  EXPECT_THROW(graded_body({}, {1, 1, 1}, "nobody"), InputError);
}

}  // namespace
}  // namespace dressform
