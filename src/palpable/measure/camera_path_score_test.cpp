// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/camera_path_score.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

using TrueFromFound = Transform<TrueWorldFrame, WorldFrame>;

std::array<double, 9> about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

// A camera on an arc, ten frames, each numbered three higher.
std::vector<FoundPose> arc() {
  std::vector<FoundPose> out;
  for (int i = 0; i < 10; ++i) {
    FoundPose pose{3 * i, {}};
    pose.pose.rotation = about_z(0.1 * i);
    pose.pose.translation_m = {std::cos(0.1 * i), std::sin(0.1 * i), 0.02 * i};
    out.push_back(pose);
  }
  return out;
}

TrueFromFound similarity() {
  TrueFromFound out;
  out.rotation = {0, 0, 1, 1, 0, 0, 0, 1, 0};
  out.scale = 0.3;
  out.translation_m = {5, -2, 1};
  return out;
}

std::vector<TruePose> as_truth(const std::vector<FoundPose>& found) {
  std::vector<TruePose> out;
  for (const FoundPose& pose : found) {
    out.push_back({pose.frame, similarity() * pose.pose});
    out.back().pose.scale = 1.0;
  }
  return out;
}

TEST(CameraPathScore, FindsTheSimilarityBetweenTwoWorlds) {
  const auto found = arc();
  const auto score = score_camera_path(found, as_truth(found));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->frames, 10);
  EXPECT_EQ(score->missing_frames, 0);
  EXPECT_NEAR(score->true_from_found.scale, 0.3, 1e-12);
  const Point<WorldFrame> p{{0.3, -0.7, 2.0}};
  EXPECT_LT(norm((score->true_from_found * p).v - (similarity() * p).v), 1e-12);
  EXPECT_LT(score->position_rms_percent, 1e-10);
  EXPECT_LT(score->most_rotation_deg, 1e-10);
  // Nine chords of 0.1 rad that rise by 0.02.
  EXPECT_NEAR(score->path_length, 0.3 * 9 * std::hypot(2 * std::sin(0.05), 0.02), 1e-12);
}

TEST(CameraPathScore, MeasuresErrorsOfPositionsAndRotations) {
  auto found = arc();
  const auto truth = as_truth(found);
  // Alternating turns of half a degree cancel in the common rotation.
  const double half_degree = 0.5 * std::numbers::pi / 180;
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i].pose.rotation =
        about_z(0.1 * static_cast<double>(i) + (i % 2 == 0 ? half_degree : -half_degree));
  const auto turned = score_camera_path(found, truth);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->mean_rotation_deg, 0.5, 1e-9);
  EXPECT_NEAR(turned->most_rotation_deg, 0.5, 1e-9);
  EXPECT_LT(turned->position_rms_percent, 1e-9);

  found = arc();
  // Displacements that neither a shift nor a scale explains: the sum is zero, and so is the product with the
  // positions (z rises evenly, so + - - + has no part along it).
  const double off = 0.01;
  found[0].pose.translation_m.z += off, found[3].pose.translation_m.z += off;
  found[1].pose.translation_m.z -= off, found[2].pose.translation_m.z -= off;
  const auto moved = score_camera_path(found, truth);
  ASSERT_TRUE(moved);
  const double path = 9 * std::hypot(2 * std::sin(0.05), 0.02);
  EXPECT_NEAR(moved->position_rms_percent, 100 * std::sqrt(4 * off * off / 10) / path, 1e-3);
  EXPECT_LT(moved->most_rotation_deg, 1e-9);
}

TEST(CameraPathScore, ComparesCommonFramesAndCountsMissingOnes) {
  const auto whole = arc();
  auto found = whole;
  found.erase(found.begin() + 4);
  found.push_back({1000, {}});
  const auto score = score_camera_path(found, as_truth(whole));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->frames, 9);
  EXPECT_EQ(score->missing_frames, 1);
  EXPECT_LT(score->position_rms_percent, 1e-10);
}

TEST(CameraPathScore, RefusesPathsThatDetermineNoScale) {
  const auto truth = as_truth(arc());
  auto found = arc();
  found.resize(2);
  EXPECT_FALSE(score_camera_path(found, truth));
  found = arc();
  for (FoundPose& pose : found) pose.pose.translation_m = {1, 2, 3};
  EXPECT_FALSE(score_camera_path(found, truth));
}

}  // namespace
}  // namespace palpable::measure
