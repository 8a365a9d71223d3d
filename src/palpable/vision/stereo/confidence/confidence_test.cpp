// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/confidence/confidence.hpp"

#include "palpable/vision/stereo/confidence/match_margin.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/centred_box.hpp"
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The pair as match() prepares it, for disparities 0 … 31.
MatchInput input_of(const StereoPair& pair) {
  MatchInput input = prepare_pictures(pair, Work{});
  input.disparities = 32;
  return input;
}

Raster<float> truth_of(const SyntheticScene& scene) {
  Raster<float> out(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) out(x, y) = static_cast<float>(scene.truth(x, y));
  return out;
}

TEST(MatchMargin, IsLargeAtTheOnlyMatchAndNegativeElsewhere) {
  const SyntheticScene scene = centred_box_scene(120, 90);
  const MatchInput input = input_of(render(scene));
  Raster<float> disparity_px = truth_of(scene);
  const MatchMargin right = match_margin(input, disparity_px, Work{});
  for (float& d : disparity_px.values()) d += 4.0F;
  const MatchMargin wrong = match_margin(input, disparity_px, Work{});
  for (const auto [x, y] : {Pixel{60, 45}, Pixel{30, 20}, Pixel{100, 80}}) {
    EXPECT_LT(right.cost(x, y), 5.0F);
    EXPECT_GT(right.margin(x, y), 5.0F);
    EXPECT_LT(wrong.margin(x, y), -5.0F);
  }
}

TEST(MatchMargin, IsNothingInPicturesOfOneColour) {
  const Image one{64, 48, 1, 8, std::vector<float>(64 * 48, 0.5F)};
  const MatchMargin found = match_margin(input_of({one, one, {}}), Raster<float>(64, 48, 3.0F), Work{});
  EXPECT_FLOAT_EQ(found.margin(40, 20), 0.0F);
}

TEST(MatchMargin, DoesNotDependOnTheNumberOfThreads) {
  const SyntheticScene scene = centred_box_scene(120, 130);
  const MatchInput input = input_of(render(scene));
  Work one, three;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(match_margin(input, truth_of(scene), one).margin,
            match_margin(input, truth_of(scene), three).margin);
}

double share_from(const Raster<float>& confidence, float least) {
  const auto values = confidence.values();
  return static_cast<double>(
             std::count_if(values.begin(), values.end(), [=](float c) { return c >= least; })) /
         static_cast<double>(values.size());
}

TEST(Confidence, IsLowWhereNothingCanBeKnownInEveryMethod) {
  const Image one{72, 48, 1, 8, std::vector<float>(72 * 48, 0.5F)};
  StereoOptions options;
  options.max_disparity_px = 16;
  for (const StereoMethod method : available_stereo_methods()) {
    const auto found = match({one, one, {}}, method, options, Work{});
    ASSERT_TRUE(found) << name_of(method);
    EXPECT_EQ(share_from(found->confidence, kGuessedBelow), 0.0) << name_of(method);
  }
}

TEST(Confidence, IsHighInANarrowRange) {
  const StereoPair pair = render(centred_box_scene(120, 90));
  const auto found = match({pair.left, pair.left, {}}, StereoMethod::fast, {}, Work{});
  ASSERT_TRUE(found);
  EXPECT_GT(share_from(found->confidence, 0.9F), 0.8);
}

TEST(Confidence, TellsTextureFromAPlainBoard) {
  const SyntheticScene scene = centred_box_scene(160, 120);
  const StereoPair textured = render(scene);
  StereoPair plain = textured;
  for (int y = scene.box_top; y < scene.box_bottom; ++y)
    for (int x = scene.box_left; x < scene.box_right; ++x) {
      plain.left.samples[static_cast<std::size_t>(y * scene.width + x)] = 0.5F;
      plain.right.samples[static_cast<std::size_t>(y * scene.width + x - static_cast<int>(scene.box_px))] =
          0.5F;
    }
  const auto known = match(textured, StereoMethod::fast, {}, Work{}),
             guessed = match(plain, StereoMethod::fast, {}, Work{});
  ASSERT_TRUE(known && guessed);
  EXPECT_GT(share_from(known->confidence, 0.9F), 0.7);
  EXPECT_GT(known->confidence(80, 60), 0.9F);
  EXPECT_LT(guessed->confidence(80, 60), kGuessedBelow);
}

}  // namespace
}  // namespace palpable::vision
