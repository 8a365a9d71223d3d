// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/stereo_options.hpp"

#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <set>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(StereoOptions, OfEveryMethodAreValidByDefaultWithUniqueNames) {
  StereoOptions options;
  for (const StereoMethod method : available_stereo_methods()) {
    EXPECT_TRUE(check(options, method).has_value()) << name_of(method);
    std::set<std::string> names;
    for (const Parameter& p : parameters_of(options, method)) {
      EXPECT_TRUE(names.insert(p.name).second) << p.name;
      EXPECT_LT(p.range.least, p.range.most) << p.name;
      EXPECT_FALSE(p.meaning.empty()) << p.name;
    }
    EXPECT_GT(names.size(), 20U) << name_of(method);
  }
}

TEST(StereoOptions, OutOfRangeAreRefusedByEveryMethod) {
  const StereoPair pair = render({});
  for (const StereoMethod method : available_stereo_methods()) {
    StereoOptions reference;
    const std::size_t count = parameters_of(reference, method).size();
    for (std::size_t i = 0; i < count; ++i) {
      StereoOptions options;
      const Parameter p = parameters_of(options, method)[i];
      std::visit(
          [&](auto* value) {
            *value = static_cast<std::remove_reference_t<decltype(*value)>>(p.range.most + 1.0);
          },
          p.value);
      const auto refused = match(pair, method, options, {});
      ASSERT_FALSE(refused.has_value()) << name_of(method) << ' ' << p.name;
      EXPECT_EQ(refused.error().code, ErrorCode::usage);
    }
  }
}

TEST(StereoOptions, ChangeOnlyTheirOwnMethod) {
  const StereoPair pair = render(slanted_scene());
  StereoOptions changed;
  changed.fast.large_step = 20.0F;
  const auto before = match(pair, StereoMethod::fast, {}, {}),
             after = match(pair, StereoMethod::fast, changed, {});
  ASSERT_TRUE(before && after);
  EXPECT_FALSE(before->disparity.disparity_px == after->disparity.disparity_px);
  changed.scanline.map.path.jump = 41.0F;
  EXPECT_TRUE(check(changed, StereoMethod::scanline).has_value());
  const auto same = match(pair, StereoMethod::fast, changed, {});
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->disparity.disparity_px == after->disparity.disparity_px);
}

TEST(StereoOptions, RefuseWindowsAndCostsThatWouldOverflow) {
  StereoOptions options;
  options.scanline.map.window.row_reach_px = 40;
  EXPECT_FALSE(check(options, StereoMethod::scanline).has_value());
  options.fast.cost.colour_limit = 255;
  EXPECT_FALSE(check(options, StereoMethod::fast).has_value());
  options.best.volume.cross.row_reach_px = kLongestVolumeArm + 1;
  EXPECT_FALSE(check(options, StereoMethod::best).has_value());
}

}  // namespace
}  // namespace palpable::vision
