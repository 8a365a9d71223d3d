// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/matched_source.hpp"

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;

/// A pair of cameras before a slope with a box; two pairs, then nothing.
class TwoPairs final : public PairSource {
 public:
  Result<std::optional<LivePair>> take(Clock::time_point /*deadline*/) override {
    if (has_ended()) return std::optional<LivePair>();
    auto pair = vision::render(vision::slanted_scene());
    return std::optional(LivePair{next_++, Clock::now(), std::move(pair.left), std::move(pair.right)});
  }
  bool has_ended() const override { return next_ == 2; }

 private:
  std::uint64_t next_ = 0;
};

StereoRig rig(int width, int height) {
  const double f = 1.25 * width;
  return {{f, f, 0.5 * (width - 1), 0.5 * (height - 1), width, height}, 0.1, 0.0};
}

TEST(MatchedSource, GivesTheMetricDepthOfACalibratedPair) {
  // The calibration is for pictures of twice the size.
  const auto source = matched_source(std::make_unique<TwoPairs>(), rig(320, 192), {});
  const auto frame = source->take(Clock::now());
  ASSERT_TRUE(frame && *frame) << frame.error().sentence();
  // In the middle of the box: 1.25 * 160 * 0.1 / 14 px.
  EXPECT_NEAR((*frame)->depth.depth_m(90, 50), 20.0 / 14.0, 0.03);
  EXPECT_EQ((*frame)->number, 0U);
  ASSERT_TRUE(source->colour());
  EXPECT_EQ(source->colour()->width, 160);
  // A quarter of a pixel: z^2 / (200 px * 0.1 m) a pixel.
  EXPECT_NEAR(source->noise().per_m2, 0.25 / 20.0, 1e-9);
  EXPECT_TRUE(*source->take(Clock::now()));
  EXPECT_TRUE(source->has_ended());
  EXPECT_FALSE(*source->take(Clock::now()));
}

TEST(MatchedSource, GivesProportionsOfAPairThatIsNotCalibrated) {
  const auto source = matched_source(std::make_unique<TwoPairs>(), std::nullopt, {});
  const auto frame = source->take(Clock::now());
  ASSERT_TRUE(frame && *frame);
  const auto& depth_m = (*frame)->depth.depth_m;
  const auto truth = vision::slanted_scene();
  EXPECT_NEAR(depth_m(130, 20) / depth_m(90, 50), truth.truth(90, 50) / truth.truth(130, 20), 0.05);
}

TEST(MatchedSource, RefusesTheCalibrationOfPicturesOfOtherProportions) {
  const auto source = matched_source(std::make_unique<TwoPairs>(), rig(320, 240), {});
  const auto frame = source->take(Clock::now());
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::invalid_input);
  EXPECT_NE(frame.error().message.find("320 x 240"), std::string::npos) << frame.error().message;
}

}  // namespace
}  // namespace palpable::session
