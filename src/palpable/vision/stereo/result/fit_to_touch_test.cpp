// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/centred_box.hpp"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

using ::testing::HasSubstr;

FitToTouch judged(const StereoPair& pair) {
  const auto match = vision::match(pair, StereoMethod::fast, {}, Work{});
  EXPECT_TRUE(match);
  return fit_to_touch(pair, *match, Work{});
}

SyntheticScene scene() { return centred_box_scene(240, 180); }

TEST(FitToTouch, AcceptsAGoodPair) {
  const FitToTouch fit = judged(render(scene()));
  EXPECT_GT(fit.agreement, 0.8);
  EXPECT_GT(fit.coverage, 0.7);
  EXPECT_THAT(sentence_of(fit), HasSubstr("is fit to touch"));
}

TEST(FitToTouch, ReportsMissingTextureWithItsPlace) {
  StereoPair pair = render(scene());
  for (Image* picture : {&pair.left, &pair.right})
    for (int y = 120; y < picture->height; ++y)
      for (int x = 0; x < picture->width; ++x)
        for (int c = 0; c < picture->channels; ++c)
          picture->samples[static_cast<std::size_t>((y * picture->width + x) * picture->channels + c)] = 0.5F;
  const FitToTouch fit = judged(pair);
  EXPECT_LT(fit.textured, 0.8);
  EXPECT_THAT(sentence_of(fit), HasSubstr("no texture"));
  EXPECT_THAT(sentence_of(fit), HasSubstr("at the bottom"));
}

TEST(FitToTouch, SaysThatTheLensIsCovered) {
  StereoPair pair = render(scene());
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0.02F, 0.01F);
  for (Image* picture : {&pair.left, &pair.right})
    for (float& v : picture->samples) v = std::clamp(noise(random), 0.0F, 1.0F);
  EXPECT_THAT(sentence_of(judged(pair)), HasSubstr("take the cap off the lens"));
}

TEST(FitToTouch, DoesNotCountGuessesAsCovered) {
  const StereoPair pair = render(scene());
  auto match = vision::match(pair, StereoMethod::fast, {}, Work{});
  ASSERT_TRUE(match);
  const FitToTouch known = fit_to_touch(pair, *match, Work{});
  EXPECT_LT(known.guessed, 0.2);
  EXPECT_THAT(sentence_of(known), testing::Not(HasSubstr("guessed")));
  std::fill(match->confidence.values().begin(), match->confidence.values().end(), 0.3F);
  const FitToTouch guessed = fit_to_touch(pair, *match, Work{});
  EXPECT_EQ(guessed.coverage, 0.0);
  EXPECT_EQ(guessed.guessed, 1.0);
  EXPECT_EQ(guessed.agreement, known.agreement);
  EXPECT_FALSE(guessed.fit);
  EXPECT_THAT(sentence_of(guessed), HasSubstr("the depth of 100 % is guessed from its surroundings"));
}

TEST(FitToTouch, RefusesADepthThatIsInsideOut) {
  const StereoPair pair = render(scene());
  auto match = vision::match(pair, StereoMethod::fast, {}, Work{});
  ASSERT_TRUE(match);
  // The points lie within 20 px of any depth here: their order alone says that it is wrong.
  FitThresholds thresholds;
  thresholds.confirming.agree_px = 20.0;
  EXPECT_TRUE(fit_to_touch(pair, *match, Work{}, thresholds).fit);
  for (float& d : match->disparity.disparity_px.values()) d = 20.0F - d;
  const FitToTouch fit = fit_to_touch(pair, *match, Work{}, thresholds);
  EXPECT_FALSE(fit.fit);
  EXPECT_EQ(fit.reason, FitReason::other_order);
  EXPECT_THAT(sentence_of(fit), HasSubstr("do not agree with how distinct points moved"));
}

Image quarter_turned(const Image& image) {
  Image out = image;
  std::swap(out.width, out.height);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      std::copy_n(image.pixel(image.width - 1 - y, x), channels,
                  out.samples.begin() + (out.pixel(x, y) - out.samples.data()));
  return out;
}

TEST(FitToTouch, IsTrueOnlyWithParallaxAlongTheRows) {
  const StereoPair pair = render(scene());
  const FitToTouch good = judged(pair);
  EXPECT_TRUE(good.fit);
  EXPECT_EQ(good.reason, FitReason::all_agree);
  EXPECT_GT(good.confidence, 0.5);

  const FitToTouch twice = judged({pair.left, pair.left, {}});
  EXPECT_FALSE(twice.fit);
  EXPECT_EQ(twice.reason, FitReason::no_parallax);
  EXPECT_THAT(sentence_of(twice), HasSubstr("near and far moved alike"));

  const FitToTouch exchanged = judged({pair.right, pair.left, {}});
  EXPECT_TRUE(exchanged.fit) << sentence_of(exchanged);
  EXPECT_NEAR(exchanged.agreement, good.agreement, 0.05);
  EXPECT_NEAR(exchanged.points.confirmed, good.points.confirmed, 0.05);

  const FitToTouch upward = judged({quarter_turned(pair.left), quarter_turned(pair.right), {}});
  EXPECT_FALSE(upward.fit) << sentence_of(upward);
}

TEST(FitToTouch, NamesPlainThingsBeforeAWallAsAReasonWhereOnlyTheWallHasPoints) {
  FitToTouch fit;
  fit.textured = 1.0;
  fit.brightness = 0.5;
  fit.reason = FitReason::no_parallax;
  fit.depth_range_px = 0.2;
  EXPECT_THAT(sentence_of(fit), ::testing::Not(HasSubstr("one colour")));
  fit.depth_range_px = 30.0;
  EXPECT_THAT(sentence_of(fit), HasSubstr("or what stands nearer is of one colour"));
}

TEST(FitToTouch, JudgesAnExchangedPairAsItWasMatchedByEveryMethod) {
  const StereoPair pair = render(scene());
  const auto match = match_confirmed({pair.right, pair.left, {}}, StereoMethod::scanline, {}, Work{});
  ASSERT_TRUE(match);
  ASSERT_TRUE(match->exchanged);
  const FitToTouch fit = fit_to_touch({pair.right, pair.left, {}}, *match, Work{});
  EXPECT_TRUE(fit.fit) << sentence_of(fit);
}

TEST(FitToTouch, SaysOfDifferentPlacesThatNoPointIsFoundInBoth) {
  FitToTouch fit;
  fit.reason = FitReason::few_points;
  fit.confidence = 1e-7;
  fit.agreement = 0.4;
  fit.coverage = 0.4;
  fit.textured = 1.0;
  fit.overlap = 0.95;
  fit.depth_range_px = 52.0;
  fit.brightness = 0.5;
  fit.trouble = Raster<std::uint8_t>(90, 90, static_cast<std::uint8_t>(Trouble::contradicted));
  EXPECT_THAT(sentence_of(fit), HasSubstr("hardly any point is found in both pictures: they show different"));
  EXPECT_THAT(sentence_of(fit), HasSubstr("turned, zoomed or mirrored"));
  EXPECT_THAT(sentence_of(fit), testing::Not(HasSubstr("feel wrong")));
  fit.brightness = 0.05;
  EXPECT_THAT(sentence_of(fit), HasSubstr("more light"));
}

TEST(FitToTouch, ObeysItsThresholds) {
  FitThresholds thresholds;
  for (const Parameter& p : parameters_of(thresholds)) EXPECT_TRUE(set_parameter(p, p.get())) << p.name;
  const StereoPair pair = render(scene());
  const auto match = vision::match(pair, StereoMethod::fast, {}, Work{});
  ASSERT_TRUE(match);
  thresholds.coverage = 1.0;
  const FitToTouch fit = fit_to_touch(pair, *match, Work{}, thresholds);
  EXPECT_FALSE(fit.fit);
  EXPECT_EQ(fit.reason, FitReason::little_depth);
}

TEST(FitToTouch, RejectsUnrelatedPictures) {
  StereoPair pair = render(scene());
  std::reverse(pair.right.samples.begin(), pair.right.samples.end());
  const FitToTouch fit = judged(pair);
  EXPECT_LT(fit.agreement, 0.5);
  EXPECT_FALSE(fit.fit);
  EXPECT_THAT(sentence_of(fit), HasSubstr("hardly fit"));
}

}  // namespace
}  // namespace palpable::vision
