// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/bundle.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Five cameras on an arc that see 40 points exactly.
Bundle exact_bundle() {
  Bundle bundle;
  const auto points = points_around_origin(40);
  for (const Vec3& p : points) bundle.points.push_back({p.x, p.y, p.z});
  for (int k = 0; k < 5; ++k) {
    const CameraPose pose = facing_origin(0.15 * k);
    bundle.poses.push_back(bundle_pose(pose));
    for (std::size_t i = 0; i < points.size(); ++i)
      bundle.observations.push_back({k, static_cast<int>(i), seen_from(pose, points[i])});
  }
  return bundle;
}

double rms_px(const Bundle& bundle, const Pinhole& camera) {
  double sum = 0.0;
  for (const Observation& o : bundle.observations) {
    const double error = projection_error_px(camera, bundle.poses[static_cast<std::size_t>(o.pose)],
                                             bundle.points[static_cast<std::size_t>(o.point)], o.place);
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(bundle.observations.size()));
}

TEST(Bundle, ConvertsAPoseThereAndBack) {
  const CameraPose pose = facing_origin(0.7);
  const CameraPose again = camera_pose(bundle_pose(pose));
  EXPECT_NEAR(norm(again.translation_m - pose.translation_m), 0.0, 1e-12);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(again.rotation[i], pose.rotation[i], 1e-12);
}

TEST(Bundle, MeasuresTheErrorOfAProjectionInPixels) {
  const BundlePose at_origin{};
  // A point 2 in front and 0.1 to the right is 0.1 / 2 * 500 = 25 px right of the centre.
  const std::array<double, 3> point{0.1, 0.0, 2.0};
  EXPECT_NEAR(projection_error_px(kExactCamera, at_origin, point, {319.5 + 25, 239.5}), 0.0, 1e-9);
  EXPECT_NEAR(projection_error_px(kExactCamera, at_origin, point, {319.5 + 28, 239.5 - 4}), 5.0, 1e-9);
  EXPECT_TRUE(std::isinf(projection_error_px(kExactCamera, at_origin, {0.1, 0.0, -2.0}, {319.5, 239.5})));
}

TEST(Bundle, FindsDisturbedPosesAndPointsAgainUpToScale) {
  const Bundle truth = exact_bundle();
  EXPECT_LT(rms_px(truth, kExactCamera), 1e-9);
  Bundle bundle = truth;
  for (std::size_t k = 1; k < bundle.poses.size(); ++k)
    for (std::size_t i = 0; i < 6; ++i)
      bundle.poses[k][i] += 0.005 * std::sin(7.0 * static_cast<double>(6 * k + i));
  for (std::size_t p = 0; p < bundle.points.size(); ++p)
    bundle.points[p][p % 3] += 0.01 * std::cos(static_cast<double>(p));
  ASSERT_GT(rms_px(bundle, kExactCamera), 1.0);
  adjust_bundle(bundle, kExactCamera, {.most_iterations = 50}, {});
  EXPECT_LT(rms_px(bundle, kExactCamera), 1e-3);
  EXPECT_EQ(bundle.poses[0], truth.poses[0]);
  // Distances between cameras, whose common factor is free.
  const auto between = [](const Bundle& b, std::size_t i, std::size_t k) {
    return norm(camera_pose(b.poses[i]).translation_m - camera_pose(b.poses[k]).translation_m);
  };
  for (std::size_t k = 1; k + 1 < truth.poses.size(); ++k)
    EXPECT_NEAR(between(bundle, 0, k) / between(bundle, 0, 4), between(truth, 0, k) / between(truth, 0, 4),
                1e-4);
}

TEST(Bundle, FindsTheFocalLength) {
  Bundle bundle = exact_bundle();
  Pinhole wrong = kExactCamera;
  wrong.fx = wrong.fy = 520;
  adjust_bundle(bundle, wrong, {.most_iterations = 100, .refine_focal_length = true}, {});
  EXPECT_NEAR(520 * bundle.focal_scale, 500.0, 0.5);
}

}  // namespace
}  // namespace palpable::vision
