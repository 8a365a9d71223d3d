// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_depths.hpp"

#include "palpable/session/touch/live_feed.hpp"
#include "palpable/sources/live/frame_folder.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path depths_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("recorded-depths-" + name);
  fs::remove_all(folder);
  return folder;
}

/// A slope of 32 x 24 pixels that begins at `near_m`, in steps of `step_m`; its first pixel is unknown.
DepthMap slope(double near_m, double step_m) {
  DepthMap depth{Raster<float>(32, 24), Pinhole{30.0, 31.0, 15.5, 11.5, 32, 24}};
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) depth.depth_m(x, y) = static_cast<float>(near_m + step_m * (x + y));
  depth.depth_m(0, 0) = kUnknownDepth;
  return depth;
}

void expect_equal(const Raster<float>& seen, const Raster<float>& shown) {
  ASSERT_EQ(seen.count(), shown.count());
  for (std::size_t k = 0; k < seen.count(); ++k) {
    const float a = seen.values()[k], b = shown.values()[k];
    EXPECT_EQ(std::isfinite(a), std::isfinite(b)) << k;
    if (std::isfinite(a)) {
      EXPECT_NEAR(a, b, 1e-6) << k;
    }
  }
}

TEST(RecordedDepths, AreShownAgainByAFolderWithTheirCameraPosesAndColours) {
  const auto folder = depths_folder("again");
  const Transform<WorldFrame, palpable::CameraFrame> pose{
      {0, -1, 0, 1, 0, 0, 0, 0, 1}, {0.5, -0.25, 1.0}, 1.0};
  Image colour{32, 24, 3, 8, std::vector<float>(32 * 24 * 3, 0.2F)};
  {
    const auto recorder = DepthRecorder::open(folder);
    ASSERT_TRUE(recorder) << recorder.error().sentence();
    (*recorder)->keep({4, Clock::now(), slope(0.8, 0.003), pose}, colour);
    (*recorder)->keep({6, Clock::now(), slope(0.9, 0.003), {}}, {});
    EXPECT_FALSE((*recorder)->notice());
  }
  const auto frames = sources::FrameFolder::open(folder);
  ASSERT_TRUE(frames) << frames.error().sentence();
  ASSERT_EQ(frames->size(), 2U);
  const auto first = frames->depth(0);
  ASSERT_TRUE(first) << first.error().sentence();
  EXPECT_EQ(first->camera, slope(0.8, 0.003).camera);
  expect_equal(slope(0.8, 0.003).depth_m, first->depth_m);
  expect_equal(slope(0.9, 0.003).depth_m, frames->depth(1)->depth_m);
  const auto at = frames->pose(0);
  ASSERT_TRUE(at && *at);
  EXPECT_EQ((*at)->translation_m, pose.translation_m);
  EXPECT_FALSE(*frames->pose(1));
  const auto picture = frames->colour(0);
  ASSERT_TRUE(picture) << picture.error().sentence();
  EXPECT_NEAR(picture->samples.front(), 0.2F, 1e-6F);
  EXPECT_FALSE(frames->colour(1));
  EXPECT_EQ(DepthRecorder::open(folder).error().code, ErrorCode::usage);
}

TEST(RecordedDepths, StateACameraThatComesAfterTheFirstFrame) {
  const auto folder = depths_folder("late-camera");
  const DepthMap known = slope(0.8, 0.0003);
  DepthMap unknown = known;
  unknown.camera.reset();
  {
    const auto recorder = DepthRecorder::open(folder);
    ASSERT_TRUE(recorder);
    for (const DepthMap& depth : {unknown, unknown, known})
      (*recorder)->keep({0, Clock::now(), depth, {}}, {});
  }
  const auto frames = sources::FrameFolder::open(folder);
  ASSERT_TRUE(frames);
  const auto first = frames->depth(0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->camera, known.camera);
  expect_equal(known.depth_m, first->depth_m);
}

TEST(RecordedDepths, KeepTenthsOfMillimetresWhereTheCameraHasThem) {
  const auto folder = depths_folder("tenths");
  {
    const auto recorder = DepthRecorder::open(folder);
    ASSERT_TRUE(recorder);
    (*recorder)->keep({0, Clock::now(), slope(0.8, 0.0003), {}}, {});
    (*recorder)->keep({1, Clock::now(), slope(6.54, 0.001), {}}, {});
  }
  const auto frames = sources::FrameFolder::open(folder);
  ASSERT_TRUE(frames);
  expect_equal(slope(0.8, 0.0003).depth_m, frames->depth(0)->depth_m);
  // What is beyond the unit's reach is unknown.
  EXPECT_TRUE(std::isfinite(frames->depth(1)->depth_m(1, 0)));
  EXPECT_FALSE(std::isfinite(frames->depth(1)->depth_m(31, 23)));
}

/// One picture of a slope.
class OneFrame final : public LiveSource {
 public:
  Result<std::optional<LiveFrame>> take(Clock::time_point /*deadline*/) override {
    return std::optional(LiveFrame{0, Clock::now(), slope(0.8, 0.003)});
  }
  bool has_ended() const override { return false; }
  std::optional<Image> colour() override { return std::nullopt; }
};

TEST(RecordedDepths, AreThoseOfAFeed) {
  LiveOptions options;
  options.record_to = depths_folder("feed");
  { ASSERT_TRUE(LiveFeed::open(std::make_unique<OneFrame>(), options, {})); }
  const auto frames = sources::FrameFolder::open(options.record_to);
  ASSERT_TRUE(frames) << frames.error().sentence();
  EXPECT_EQ(frames->size(), 1U);
  EXPECT_EQ(LiveFeed::open(std::make_unique<OneFrame>(), options, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::session
