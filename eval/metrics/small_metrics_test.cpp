#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/metrics/fit_metrics.h"
#include "eval/metrics/girths.h"
#include "eval/metrics/image_metrics.h"
#include "eval/metrics/intersections.h"
#include "eval/metrics/label_metrics.h"
#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/registration_metrics.h"
#include "eval/metrics/rim_metrics.h"
#include "eval/metrics/test_meshes.h"

namespace dressform::metrics {
namespace {

using namespace test_meshes;

Isometry3d turn(double degrees, const Vector3d& axis) {
  return Isometry3d(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
}

TEST(RegistrationMetrics, SmallAndLargeAngles) {
  const Isometry3d truth = Eigen::Translation3d(1, 2, 3) * turn(77, {1, 2, 3});
  for (const double degrees : {0.0, 1e-6, 0.01, 0.5, 30.0, 179.0}) {
    const Isometry3d estimate = truth * turn(degrees, {3, -1, 2});
    EXPECT_NEAR(rotation_error_deg(estimate, truth), degrees, 1e-7 + 1e-9 * degrees);
    EXPECT_NEAR(translation_error_mm(estimate, truth), 0, 1e-9) << "turned about its own centre";
  }
  EXPECT_NEAR(translation_error_mm(Eigen::Translation3d(0, 0.003, 0.004) * truth, truth), 5, 1e-9);
}

TEST(RegistrationMetrics, TargetError) {
  const Isometry3d truth = Eigen::Translation3d(0, 0, -2) * Isometry3d::Identity();
  const std::vector<Vector3d> targets{{0, 1, 0}, {0, -1, 0}};
  EXPECT_NEAR(target_registration_error_mm(Eigen::Translation3d(0.003, 0, 0) * truth, truth, targets), 3, 1e-9);
  // Turned by a about the camera's own axis: each target moves by 2 sin(a / 2) m.
  EXPECT_NEAR(target_registration_error_mm(truth * turn(0.5, {0, 0, 1}), truth, targets),
              2000 * std::sin(0.25 * M_PI / 180), 1e-6);
  EXPECT_TRUE(std::isnan(target_registration_error_mm(truth, truth, {})));
}

TEST(RegistrationMetrics, TargetsAreWhatTheSensorSees) {
  const Mesh two = joined(sphere(0.3, {0, 0, 0}, 20), sphere(0.3, {0, 0, 1}, 20));
  const Isometry3d sensor = Eigen::Translation3d(0, 0, -3) * Isometry3d::Identity();
  const auto seen = points_seen(two, sensor, 0.02, 1);
  ASSERT_GT(seen.size(), 500u);
  for (const auto& point : seen) EXPECT_TRUE(point.z() < 0 || point.head<2>().norm() > 0.2);
  int behind = 0;
  for (const auto& point : seen) behind += point.z() > 0.5;
  EXPECT_LT(behind, 100) << "the second ball hides behind the first";
}

ClosedLine circle(double radius, double height, int count) {
  ClosedLine line;
  for (int i = 0; i < count; ++i)
    line.push_back({radius * std::cos(2 * M_PI * i / count), height, radius * std::sin(2 * M_PI * i / count)});
  return line;
}

TEST(RimMetrics, ConcentricAndShiftedCircles) {
  EXPECT_NEAR(closed_length(circle(0.1, 0, 400)), 0.2 * M_PI, 1e-4);
  const auto same = compare_lines(circle(0.1, 0, 100), circle(0.1, 0, 100));
  EXPECT_LT(same.hd95_mm, 1e-9);
  const auto lifted = compare_lines(circle(0.1, 0.02, 400), circle(0.1, 0, 400));
  EXPECT_NEAR(lifted.chamfer_mm, 20, 0.01);
  EXPECT_NEAR(lifted.hd95_mm, 20, 0.01);
  EXPECT_NEAR(compare_lines(circle(0.11, 0, 400), circle(0.1, 0, 400)).chamfer_mm, 10, 0.05);
}

TEST(RimMetrics, MatchesByLeastTotalDistance) {
  const std::vector<ClosedLine> truth{circle(0.1, 0, 50), circle(0.1, 1, 50), circle(0.1, 2, 50)};
  const std::vector<ClosedLine> estimate{circle(0.1, 2.1, 50), circle(0.1, 0.1, 50)};
  EXPECT_EQ(match_lines(estimate, truth), (std::vector<int>{1, -1, 0}));
  EXPECT_EQ(match_lines({}, truth), (std::vector<int>{-1, -1, -1}));
  EXPECT_EQ(match_lines(truth, {truth[2]}), (std::vector<int>{2}));
}

TEST(RimMetrics, AssignmentIsOptimal) {
  Eigen::MatrixXd cost(4, 5);
  cost << 7, 5, 9, 8, 11, 9, 12, 7, 11, 10, 8, 5, 4, 6, 9, 7, 3, 6, 9, 6;
  const auto found = assign(cost);
  double total = 0;
  for (int i = 0; i < 4; ++i) total += cost(i, found[i]);
  double best = 1e9;
  std::vector<int> order{0, 1, 2, 3, 4};
  do {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += cost(i, order[i]);
    best = std::min(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(total, best);
  const auto turned = assign(cost.transpose());
  EXPECT_EQ(std::count(turned.begin(), turned.end(), -1), 1);
}

TEST(LabelMetrics, Overlap) {
  cv::Mat truth(100, 100, CV_8UC1, cv::Scalar(0)), estimate = truth.clone();
  truth(cv::Rect(20, 20, 40, 40)) = 2;
  estimate(cv::Rect(30, 20, 40, 40)) = 2;
  EXPECT_NEAR(label_iou(estimate, truth, 2), 30.0 / 50, 1e-12);
  EXPECT_EQ(label_iou(truth, truth, 2), 1);
  EXPECT_EQ(label_iou(truth, truth, 3), 1) << "empty in both";
  EXPECT_EQ(label_iou(truth, truth * 0, 2), 0);
  EXPECT_NEAR(foreground_leakage(estimate, truth), 0.25, 1e-12);
  EXPECT_NEAR(foreground_miss(estimate, truth), 0.25, 1e-12);
  EXPECT_EQ(foreground_leakage(truth * 0, truth), 0);
}

TEST(LabelMetrics, Outlines) {
  cv::Mat truth(100, 100, CV_8UC1, cv::Scalar(0)), shifted = truth.clone(), off = truth.clone();
  truth(cv::Rect(20, 20, 40, 40)) = 1;
  shifted(cv::Rect(22, 20, 40, 40)) = 1;
  off(cv::Rect(24, 24, 40, 40)) = 1;
  EXPECT_EQ(boundary_f(truth, truth, 1), 1);
  EXPECT_EQ(boundary_f(shifted, truth, 1, 2), 1) << "two pixels are within tolerance";
  EXPECT_LT(boundary_f(off, truth, 1, 2), 0.2);
  EXPECT_EQ(boundary_f(truth * 0, truth, 1), 0);
  EXPECT_EQ(boundary_f(truth * 0, truth * 0, 1), 1);
}

TEST(ImageMetrics, Psnr) {
  const cv::Mat a(20, 20, CV_8UC3, cv::Scalar(100, 100, 100)), b(20, 20, CV_8UC3, cv::Scalar(110, 100, 100));
  const cv::Mat all(20, 20, CV_8UC1, cv::Scalar(255));
  EXPECT_NEAR(psnr_db(a, b, all), 10 * std::log10(255.0 * 255 * 3 / 100), 1e-9);
  EXPECT_TRUE(std::isinf(psnr_db(a, a, all)));
  EXPECT_TRUE(std::isnan(psnr_db(a, b, all * 0)));
}

// The definition, window by window.
double ssim_at(const cv::Mat& a, const cv::Mat& b, int cx, int cy) {
  double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (int y = -5; y <= 5; ++y)
    for (int x = -5; x <= 5; ++x) {
      const double w = std::exp(-(x * x + y * y) / (2 * 1.5 * 1.5));
      const double p = a.at<unsigned char>(cy + y, cx + x), q = b.at<unsigned char>(cy + y, cx + x);
      weights += w;
      ma += w * p;
      mb += w * q;
      aa += w * p * p;
      bb += w * q * q;
      ab += w * p * q;
    }
  ma /= weights;
  mb /= weights;
  const double va = aa / weights - ma * ma, vb = bb / weights - mb * mb, cov = ab / weights - ma * mb;
  return (2 * ma * mb + 6.5025) * (2 * cov + 58.5225) / ((ma * ma + mb * mb + 6.5025) * (va + vb + 58.5225));
}

TEST(ImageMetrics, SsimByDefinition) {
  cv::Mat a(40, 50, CV_8UC1), b(40, 50, CV_8UC1);
  cv::RNG generator(4);
  generator.fill(a, cv::RNG::UNIFORM, 0, 256);
  generator.fill(b, cv::RNG::UNIFORM, 0, 256);
  b = a * 0.7 + b * 0.3;
  const cv::Mat map = ssim_map(a, b);
  ASSERT_EQ(map.size(), cv::Size(40, 30));
  for (const auto& [x, y] : {std::pair(5, 5), std::pair(20, 17), std::pair(44, 34)})
    EXPECT_NEAR(map.at<double>(y - 5, x - 5), ssim_at(a, b, x, y), 1e-9);
  EXPECT_NEAR(masked_ssim(a, a, cv::Mat(40, 50, CV_8UC1, cv::Scalar(1))), 1, 1e-12);
  EXPECT_TRUE(std::isnan(masked_ssim(a, b, cv::Mat(40, 50, CV_8UC1, cv::Scalar(0)))));
  cv::Mat one(40, 50, CV_8UC1, cv::Scalar(0));
  one.at<unsigned char>(17, 20) = 1;
  EXPECT_NEAR(masked_ssim(a, b, one), ssim_at(a, b, 20, 17), 1e-9);
}

TEST(ImageMetrics, Ciede2000OnSharmasPairs) {
  const double pairs[34][7] = {{50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425},
                               {50, 3.1571, -77.2803, 50, 0, -82.7485, 2.8615},
                               {50, 2.8361, -74.0200, 50, 0, -82.7485, 3.4412},
                               {50, -1.3802, -84.2814, 50, 0, -82.7485, 1.0000},
                               {50, -1.1848, -84.8006, 50, 0, -82.7485, 1.0000},
                               {50, -0.9009, -85.5211, 50, 0, -82.7485, 1.0000},
                               {50, 0, 0, 50, -1, 2, 2.3669},
                               {50, -1, 2, 50, 0, 0, 2.3669},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0009, 7.1792},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0010, 7.1792},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0011, 7.2195},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0012, 7.2195},
                               {50, -0.0010, 2.4900, 50, 0.0009, -2.4900, 4.8045},
                               {50, -0.0010, 2.4900, 50, 0.0010, -2.4900, 4.8045},
                               {50, -0.0010, 2.4900, 50, 0.0011, -2.4900, 4.7461},
                               {50, 2.5, 0, 50, 0, -2.5, 4.3065},
                               {50, 2.5, 0, 73, 25, -18, 27.1492},
                               {50, 2.5, 0, 61, -5, 29, 22.8977},
                               {50, 2.5, 0, 56, -27, -3, 31.9030},
                               {50, 2.5, 0, 58, 24, 15, 19.4535},
                               {50, 2.5, 0, 50, 3.1736, 0.5854, 1.0000},
                               {50, 2.5, 0, 50, 3.2972, 0, 1.0000},
                               {50, 2.5, 0, 50, 1.8634, 0.5757, 1.0000},
                               {50, 2.5, 0, 50, 3.2592, 0.3350, 1.0000},
                               {60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644},
                               {63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630},
                               {61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731},
                               {35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645},
                               {22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373},
                               {36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146},
                               {90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441},
                               {90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381},
                               {6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377},
                               {2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082}};
  for (const auto& p : pairs) {
    EXPECT_NEAR(ciede2000({p[0], p[1], p[2]}, {p[3], p[4], p[5]}), p[6], 5e-5) << p[1] << " " << p[2];
    EXPECT_NEAR(ciede2000({p[3], p[4], p[5]}, {p[0], p[1], p[2]}), p[6], 5e-5);
  }
}

TEST(ImageMetrics, LabOfKnownColours) {
  const auto white = lab_of_srgb(255, 255, 255), red = lab_of_srgb(255, 0, 0);
  EXPECT_NEAR(white[0], 100, 1e-3);
  EXPECT_NEAR(white[1], 0, 0.02);
  EXPECT_NEAR(red[0], 53.24, 0.01);
  EXPECT_NEAR(red[1], 80.09, 0.01);
  EXPECT_NEAR(red[2], 67.20, 0.01);
}

TEST(ImageMetrics, GainIsFoundAndTakenOut) {
  cv::Mat truth(30, 30, CV_8UC3);
  cv::RNG generator(9);
  generator.fill(truth, cv::RNG::UNIFORM, 20, 120);
  const cv::Mat brighter = with_gain(truth, {1.5, 1.2, 0.8}), mask(30, 30, CV_8UC1, cv::Scalar(255));
  const cv::Vec3d gain = gain_to_match({brighter}, {truth}, {mask});
  EXPECT_NEAR(gain[0], 1 / 1.5, 0.01);
  EXPECT_NEAR(gain[1], 1 / 1.2, 0.01);
  EXPECT_NEAR(gain[2], 1 / 0.8, 0.01);
  EXPECT_LE(cv::norm(with_gain(brighter, gain), truth, cv::NORM_INF), 2);
  EXPECT_EQ(gain_to_match({brighter}, {truth}, {mask * 0}), cv::Vec3d(1, 1, 1));
}

TEST(Intersections, CountsPairs) {
  const Mesh ball = sphere(0.5, {0, 0, 0}, 12);
  EXPECT_EQ(intersecting_pairs(ball, moved(ball, {2, 0, 0})), 0);
  EXPECT_EQ(intersecting_pairs(sphere(0.3, {0, 0, 0}, 12), ball), 0) << "wholly inside: no triangles meet";
  EXPECT_GT(intersecting_pairs(ball, moved(ball, {0.3, 0, 0})), 10);
  EXPECT_EQ(intersecting_pairs(square(1, 0, 1), square(1, 1e-12, 1)), 0);
  EXPECT_EQ(intersecting_pairs(square(1, 0, 1), square(1, 0, 1)), 4) << "touching counts";
  Mesh flat;
  flat.vertices = {{0.5, 0.4, -1}, {0.5, 0.4, 0}, {0.5, 0.4, 1}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(intersecting_pairs(flat, square(1, 0, 1)), 1) << "a triangle without area still cuts";
}

TEST(Intersections, OfAMeshWithItself) {
  const Mesh ball = sphere(1, {0, 0, 0}, 20);
  EXPECT_EQ(self_intersecting_pairs(ball), 0) << "neighbours touch, and do not cross";
  const Mesh other = moved(ball, {0.3, 0.1, 0});
  EXPECT_EQ(self_intersecting_pairs(joined(ball, other)), intersecting_pairs(ball, other));
  // A fan round one vertex of which the last triangle is folded through the first.
  Mesh fan;
  fan.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.9, 0.3, 0.5}, {0.6, 0.2, -0.5}};
  fan.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(self_intersecting_pairs(fan), 0);
  fan.triangles.emplace_back(0, 4, 5);
  EXPECT_EQ(self_intersecting_pairs(fan), 1);
  EXPECT_EQ(self_intersecting_pairs(Mesh{}), 0);
}

TEST(Penetration, DepthOfAShiftedSquareInABall) {
  const Mesh ball = sphere(0.5, {0, 0, 0}, 80);
  const auto outside = penetration(moved(square(0.2, 0, 4), {-0.1, -0.1, 0.6}), ball);
  EXPECT_EQ(outside.max_mm, 0);
  EXPECT_EQ(outside.components_inside, 0);
  const auto within = penetration(moved(square(0.02, 0, 4), {-0.01, -0.01, 0.45}), ball, 0.001);
  EXPECT_NEAR(within.mean_mm, 50, 0.7);
  EXPECT_NEAR(within.area_cm2, 4, 1e-9);
  EXPECT_EQ(within.components_inside, 1);
  // Half of a square inside a cube-like tube: the area that is more than 1 mm deep.
  const auto half =
      penetration(moved(square(0.2, 0, 8), {0, -0.1, 0}), tube(0.1, 0.1, {0, 0, 0}, -1, 1, 256, 4, true), 0.001);
  EXPECT_NEAR(half.area_cm2, 200 * 0.99, 3);
  EXPECT_NEAR(half.max_mm, 100, 1);
}

TEST(Penetration, SignAgreesWithTheWindingNumber) {
  const Mesh probe = moved(square(1, 0.013, 30), {-0.5, 0.7003, 0});
  const Mesh torso = tube(0.18, 0.12, {0, 0, 0}, 0.85, 1.4, 9, 3, true);  // sharp edges: sides and corners are nearest
  for (const auto& vertex : probe.vertices) {
    const Mesh dot{{vertex, vertex + Vector3d(1e-5, 0, 0), vertex + Vector3d(0, 1e-5, 0)}, {{0, 1, 2}}};
    EXPECT_EQ(penetration(dot, torso).max_mm > 0, winding_number(torso, vertex) > 0.5) << vertex.transpose();
  }
}

TEST(EdgeStretch, ScaledMesh) {
  const Mesh before = square(1, 0, 5);
  Mesh after = before;
  for (auto& vertex : after.vertices) vertex *= 1.1;
  EXPECT_NEAR(edge_stretch_p95(before, after), 0.1, 1e-12);
  EXPECT_NEAR(edge_stretch_p95(before, before), 0, 1e-12);
  EXPECT_THROW(edge_stretch_p95(before, square(1, 0, 6)), std::invalid_argument);
}

double ellipse_girth(double a, double b) {  // Ramanujan
  const double h = std::pow((a - b) / (a + b), 2);
  return M_PI * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
}

TEST(Girths, Hull) {
  EXPECT_NEAR(hull_girth_m({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.5, 0}}), 4, 1e-12);
  EXPECT_EQ(hull_girth_m({}), 0);
}

TEST(Girths, LevelsOfAFigure) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  EXPECT_NEAR(levels->crotch_y, 0.85, 0.015);
  EXPECT_NEAR(levels->armpit_y, 1.4, 0.025);
  EXPECT_NEAR(levels->waist.y, 1.1, 0.02);
  EXPECT_NEAR(levels->waist.girth_m, ellipse_girth(0.18 * 0.85, 0.12 * 0.85), 0.003);
  EXPECT_NEAR(levels->chest.girth_m, ellipse_girth(0.18, 0.12), 0.003) << "arms are left out";
  EXPECT_NEAR(levels->hip.girth_m, ellipse_girth(0.18, 0.12), 0.004);
  EXPECT_FALSE(tape_levels(sphere(1, {0, 1, 0}, 30)));
  EXPECT_FALSE(tape_levels(Mesh{}));
}

TEST(Girths, GarmentRoundTheTorso) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  const Mesh shirt = joined(tube(0.2, 0.14, {0, 0, 0}, 0.9, 1.45, 128, 30, false),
                            tube(0.05, 0.05, {0.26, 0, 0}, 1.0, 1.4, 32, 10, false));
  const auto girth = garment_girth_m(shirt, levels->chest);
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, ellipse_girth(0.2, 0.14), 0.002) << "the sleeve is left out";
  EXPECT_FALSE(garment_girth_m(tube(0.2, 0.14, {0, 0, 0}, 0.1, 0.5, 64, 10, false), levels->chest));
  EXPECT_FALSE(garment_girth_m(tube(0.05, 0.05, {0.26, 0, 0}, 1.0, 1.4, 32, 10, false), levels->chest));
}

TEST(Girths, WideSleeveBesideTheTorsoIsLeftOut) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  // The sleeve's inner side is nearer to the torso (15 mm) than to the arm (25 mm), and is no torso's cloth for that.
  const Mesh torso = tube(0.19, 0.14, {0, 0, 0}, 0.9, 1.45, 128, 30, false);
  const Mesh sleeve = tube(0.065, 0.065, {0.26, 0, 0}, 1.0, 1.4, 64, 10, false);
  const auto girth = garment_girth_m(joined(torso, sleeve), levels->chest);
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, *garment_girth_m(torso, levels->chest), 1e-12);
  // Its slanted cuff at that height: an open line.
  Mesh cuff = sleeve;
  cuff.triangles.clear();
  for (const auto& t : sleeve.triangles)
    if (sleeve.vertices[t[0]].x() < 0.27 || sleeve.vertices[t[0]].y() > levels->chest.y + 0.05)
      cuff.triangles.push_back(t);
  EXPECT_NEAR(*garment_girth_m(joined(torso, cuff), levels->chest), *girth, 1e-12);
}

TEST(Girths, SleevesThatJoinTheTorsoAreLeftOut) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  // One tube round torso and arms: its hull is not the torso's girth.
  const Mesh cape = tube(0.32, 0.14, {0, 0, 0}, 0.9, 1.45, 400, 30, false);
  const auto girth = garment_girth_m(cape, levels->chest);
  ASSERT_TRUE(girth);
  EXPECT_LT(*girth, ellipse_girth(0.28, 0.14));
  EXPECT_GT(*girth, ellipse_girth(0.18, 0.14));
}

TEST(Girths, SectionOfAnOpenMeshIsALine) {
  const auto lines = horizontal_section(tube(0.2, 0.2, {0, 0, 0}, 0, 1, 16, 4, false), 0.3);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  Mesh slit = square(1, 0, 4);
  const auto cut = horizontal_section(slit, 0.3);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_FALSE(cut[0].closed);
  EXPECT_EQ(cut[0].points.size(), 9u);
}

}  // namespace
}  // namespace dressform::metrics
