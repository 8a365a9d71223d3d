// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/match.hpp"

#include "palpable/vision/stereo/problem/prepare_pictures.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
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
  const SyntheticScene scene = slanted_scene();
  const auto found = match(render(scene), GetParam(), {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_LE(bad_fraction(scene, found->disparity.disparity_px, 1.0, 4), 0.05);
  EXPECT_TRUE(found->notes.empty()) << found->notes.front();
}

TEST_P(EveryMethod, SaysThatOnePictureGivenTwiceIsFlat) {
  StereoPair pair = render(slanted_scene());
  pair.right = pair.left;
  const auto found = match(pair, GetParam(), {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  EXPECT_TRUE(has_note(*found, "the two pictures are the same"));
}

TEST_P(EveryMethod, IsIndependentOfTheNumberOfThreads) {
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

TEST_P(EveryMethod, ContinuesSurfacesOutsideTheOtherPicture) {
  SyntheticScene near;
  near.ground_px = 40.0;
  near.box_px = 46.0;
  const auto found = match(render(near), GetParam(), {}, {});
  ASSERT_TRUE(found);
  int bad = 0;
  for (int y = 0; y < near.height; ++y)
    for (int x = 0; x < 40; ++x)
      bad +=
          std::abs(static_cast<double>(found->disparity.disparity_px(x, y)) - near.ground_px) <= 1.0 ? 0 : 1;
  EXPECT_LE(bad, near.height * 40 / 20);
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
                         testing::Values(StereoMethod::scanline, StereoMethod::graph_cut,
                                         StereoMethod::segments, StereoMethod::pyramid, StereoMethod::fast,
                                         StereoMethod::best),
                         test_name);

double roughness(const Raster<float>& map) {
  double sum = 0.0;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 1; x + 1 < map.width(); ++x)
      sum += std::abs(static_cast<double>(map(x - 1, y) - 2.0F * map(x, y) + map(x + 1, y)));
  return sum;
}

void darken_rows(Image& image, int rows) {
  const auto samples = static_cast<std::ptrdiff_t>(image.width) * image.channels * rows;
  for (auto v = image.samples.begin(); v != image.samples.begin() + samples; ++v) *v *= 0.05F;
}

TEST(PreparedPictures, LoseACommonDarkFrameAndKeepDarknessInOnePicture) {
  SyntheticScene scene;
  scene.height = 130;
  StereoPair pair = render(scene);
  darken_rows(pair.left, 2);
  const MatchInput one = prepare_pictures(pair, {});
  EXPECT_LT(one.left_grey(80, 0), 20);
  darken_rows(pair.right, 2);
  const MatchInput both = prepare_pictures(pair, {});
  for (const int x : {0, 80, 159})
    for (const int y : {0, 1}) {
      EXPECT_EQ(both.left_grey(x, y), both.left_grey(x, 2));
      EXPECT_EQ(both.right_grey(x, y), both.right_grey(x, 2));
    }
}

TEST(Stereo, SmoothsAPyramidMoreWithALargerSurfaceWeight) {
  const StereoPair pair = render({});
  StereoOptions weak;
  weak.pyramid.surface_weight = 0.05F;
  const auto plain = match(pair, StereoMethod::pyramid, weak, {});
  const auto smooth = match(pair, StereoMethod::pyramid, {}, {});
  ASSERT_TRUE(plain && smooth);
  EXPECT_LT(roughness(smooth->disparity.disparity_px), 0.9 * roughness(plain->disparity.disparity_px));
}

TEST(Stereo, KeepsAPyramidsDepthWhenItsStepsMoveToEdges) {
  SyntheticScene scene;
  StereoOptions features;
  features.pyramid.edges = PyramidEdges::features;
  const StereoPair pair = render(scene);
  const auto area = match(pair, StereoMethod::pyramid, {}, {});
  const auto edges = match(pair, StereoMethod::pyramid, features, {});
  ASSERT_TRUE(area && edges);
  EXPECT_FALSE(area->disparity.disparity_px == edges->disparity.disparity_px);
  EXPECT_LE(bad_fraction(scene, edges->disparity.disparity_px, 1.0, 4), 0.08);
}

TEST(Stereo, MatchesPicturesOfDifferentExposure) {
  SyntheticScene scene;
  scene.right_gain = 0.4;
  const auto found = match(render(scene), StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "exposed differently"));
  EXPECT_LE(bad_fraction(scene, found->disparity.disparity_px, 1.0, 4), 0.05);
}

TEST(Stereo, ReportsAnExchangedPairAndMatchesIt) {
  StereoPair pair = render({});
  std::swap(pair.left, pair.right);
  const auto found = match(pair, StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "exchanged"));
  // The first picture stays the reference: the disparity is the ground's 6 pixels in the corner and the box's
  // 14 on the box.
  EXPECT_NEAR(static_cast<double>(found->disparity.disparity_px(20, 10)), 6.0, 0.5);
  EXPECT_NEAR(static_cast<double>(found->disparity.disparity_px(70, 50)), 14.0, 0.5);
}

TEST(Stereo, ReportsAVerticalOffset) {
  SyntheticScene scene;
  scene.right_lower_px = 5;
  const auto found = match(render(scene), StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "5 pixels lower"));
}

TEST(Stereo, ReportsUnrelatedPictures) {
  StereoPair pair = render({});
  for (int y = 0; y < pair.right.height; ++y)
    for (int x = 0; x < pair.right.width; ++x)
      pair.right.samples[static_cast<std::size_t>(y * pair.right.width + x)] =
          static_cast<float>(texture(x, y, 7));
  const auto found = match(pair, StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "little agreement"));
}

TEST(Stereo, ReportsBlackPicturesWithoutTexture) {
  const auto found = match({flat(64, 48), flat(64, 48), {}}, StereoMethod::scanline, {}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(has_note(*found, "hardly any texture"));
}

TEST(Stereo, FindsLargeAndNegativeDisparities) {
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
