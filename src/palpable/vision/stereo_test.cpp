// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo.hpp"

#include "palpable/vision/synthetic_pair.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

Image flat(int width, int height) {
  return {width, height, 1, 8,
          std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

TEST(Stereo, NamesEveryMethodBothWays) {
  for (const char* name : {"scanline", "graph-cut", "segments", "pyramid", "fast", "best"}) {
    const auto method = stereo_method_from(name);
    ASSERT_TRUE(method) << name;
    EXPECT_EQ(name_of(*method), name);
  }
  EXPECT_FALSE(stereo_method_from("sgbm"));
}

TEST(Stereo, RefusesPicturesOfDifferentSizeAndTooSmallOnes) {
  const auto differ = match({flat(20, 20), flat(21, 20), {}}, StereoMethod::scanline, {}, {});
  ASSERT_FALSE(differ);
  EXPECT_EQ(differ.error().code, ErrorCode::invalid_input);
  EXPECT_NE(differ.error().message.find("20x20"), std::string::npos);
  const auto tiny = match({flat(1, 1), flat(1, 1), {}}, StereoMethod::scanline, {}, {});
  ASSERT_FALSE(tiny);
  EXPECT_EQ(tiny.error().code, ErrorCode::invalid_input);
}

bool has_note(const StereoMatch& match, const std::string& words) {
  return std::any_of(match.notes.begin(), match.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

class EveryMethod : public testing::TestWithParam<StereoMethod> {};

TEST_P(EveryMethod, FindsABoxBeforeASlantedGround) {
  SyntheticScene scene;
  scene.slope_x = 0.02;
  scene.slope_y = 0.03;
  const auto found = match(render(scene), GetParam(), {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_LE(bad_fraction(scene, found->disparity.disparity_px, 1.0, 4), 0.05);
  EXPECT_TRUE(found->notes.empty()) << found->notes.front();
}

TEST_P(EveryMethod, GivesTheSameBytesForEveryThreadCount) {
  const StereoPair pair = render({});
  Work one;
  one.threads = 1;
  Work three;
  three.threads = 3;
  const auto a = match(pair, GetParam(), {}, one);
  const auto b = match(pair, GetParam(), {}, three);
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a->disparity.disparity_px == b->disparity.disparity_px);
}

TEST_P(EveryMethod, StopsWhenCancelled) {
  const std::atomic<bool> cancel{true};
  Work work;
  work.cancel = &cancel;
  const auto stopped = match(render({}), GetParam(), {}, work);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

std::string test_name(const testing::TestParamInfo<StereoMethod>& method) {
  std::string name(name_of(method.param));
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Stereo, EveryMethod,
                         testing::Values(StereoMethod::scanline, StereoMethod::graph_cut, StereoMethod::fast,
                                         StereoMethod::best),
                         test_name);

TEST(Stereo, LevelsPicturesOfDifferentExposure) {
  SyntheticScene scene;
  scene.right_gain = 0.4;
  const auto found = match(render(scene), StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "exposed differently"));
  EXPECT_LE(bad_fraction(scene, found->disparity.disparity_px, 1.0, 4), 0.05);
}

TEST(Stereo, SaysThatLeftAndRightAreExchangedAndMatchesThemAllTheSame) {
  StereoPair pair = render({});
  std::swap(pair.left, pair.right);
  const auto found = match(pair, StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "exchanged"));
  // The first picture stays the reference: the ground's 6 pixels in the corner, the box's 14 where it shows
  // the box.
  EXPECT_NEAR(static_cast<double>(found->disparity.disparity_px(20, 10)), 6.0, 0.5);
  EXPECT_NEAR(static_cast<double>(found->disparity.disparity_px(70, 50)), 14.0, 0.5);
}

TEST(Stereo, SaysHowFarOnePictureLiesAboveTheOther) {
  SyntheticScene scene;
  scene.right_lower_px = 5;
  const auto found = match(render(scene), StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "5 pixels lower"));
}

TEST(Stereo, SaysThatUnrelatedPicturesDoNotAgree) {
  StereoPair pair = render({});
  for (int y = 0; y < pair.right.height; ++y)
    for (int x = 0; x < pair.right.width; ++x)
      pair.right.samples[static_cast<std::size_t>(y * pair.right.width + x)] =
          static_cast<float>(texture(x, y, 7));
  const auto found = match(pair, StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "little agreement"));
}

TEST(Stereo, SaysThatBlackPicturesHaveNoTexture) {
  const auto found = match({flat(64, 48), flat(64, 48), {}}, StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "hardly any texture"));
}

TEST(Stereo, FindsTheRangeOfHalfTheWidthAndOfDisparitiesBehindInfinity) {
  SyntheticScene near;
  near.ground_px = 70.0;
  near.box_px = 82.0;
  const auto far_apart = match(render(near), StereoMethod::scanline, {}, {});
  ASSERT_TRUE(far_apart);
  EXPECT_LE(bad_fraction(near, far_apart->disparity.disparity_px, 1.0, 4), 0.1);

  SyntheticScene converging;
  converging.ground_px = -4.0;
  converging.box_px = 5.0;
  const auto both_signs = match(render(converging), StereoMethod::scanline, {}, {});
  ASSERT_TRUE(both_signs);
  EXPECT_LE(bad_fraction(converging, both_signs->disparity.disparity_px, 1.0, 4), 0.05);
}

}  // namespace
}  // namespace palpable::vision
