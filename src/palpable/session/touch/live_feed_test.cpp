// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_feed.hpp"

#include "palpable/session/touch/headless.hpp"
#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <chrono>
#include <cmath>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;

/// A camera in front of a slope with a bump that trembles from frame to frame; `frames` of them, then
/// nothing.
class MadeSource : public LiveSource {
 public:
  explicit MadeSource(std::uint64_t frames, double amplitude_m = 0.0)
      : frames_(frames), amplitude_m_(amplitude_m) {}

  Result<std::optional<LiveFrame>> take(Clock::time_point deadline) override {
    constexpr auto kPeriod = std::chrono::milliseconds(33);
    std::this_thread::sleep_until(std::min(deadline, last_ + kPeriod));
    if (next_ == frames_ || Clock::now() < last_ + kPeriod) return std::optional<LiveFrame>();
    last_ = Clock::now();
    return std::optional(LiveFrame{next_++, last_, {depth(), {}}});
  }
  bool has_ended() const override { return false; }
  std::optional<Image> colour() override { return std::nullopt; }

 private:
  Raster<float> depth() const {
    Raster<float> depth_m(80, 60);
    const double up_m = amplitude_m_ * (next_ % 2 == 0 ? 1.0 : -1.0);
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 80; ++x)
        depth_m(x, y) = static_cast<float>(1.0 + 0.002 * x + 0.05 * std::sin(0.2 * y) + up_m);
    return depth_m;
  }

  std::uint64_t frames_;
  double amplitude_m_;
  std::uint64_t next_ = 0;
  Clock::time_point last_ = Clock::now();
};

std::unique_ptr<LiveFeed> feed_of(std::uint64_t frames, double amplitude_m = 0.0) {
  auto feed = LiveFeed::open(std::make_unique<MadeSource>(frames, amplitude_m), {}, {});
  return feed ? *std::move(feed) : nullptr;
}

SceneMaker first_scene_of(const LiveFeed& feed) {
  return [&feed](const DeliverScene& deliver, const Work&) -> Result<void> {
    deliver(feed.first_scene());
    return {};
  };
}

TEST(LiveFeed, FeedsATouchWithoutEnergyFromNowhere) {
  const auto feed = feed_of(1000, 0.0003);
  ASSERT_NE(feed, nullptr);
  auto options = unprivileged(1.5);
  options.live = feed.get();
  options.session.servo.tick.fade_s = LiveOptions().fade_s;
  const auto statistics = touch_headless(first_scene_of(*feed), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  ASSERT_TRUE(statistics->live);
  EXPECT_GT(statistics->live->frames, 3U);
  EXPECT_LT(statistics->live->dropped, statistics->live->frames);
  EXPECT_EQ(statistics->live->dropped, statistics->live->frames - statistics->live->latency.count);
  EXPECT_GT(statistics->live->latency.p50_ns, 0.0);
  EXPECT_GE(statistics->live->latency.max_ns, statistics->live->latency.p50_ns);
  EXPECT_GT(statistics->servo.touch.contact_ticks, 0U);
  EXPECT_LE(statistics->servo.touch.made_max_without_controller_J, 1e-6);
  EXPECT_EQ(statistics->servo.allocations_in_ticks, 0U);
}

TEST(LiveFeed, SaysThatThePictureIsLostAndGoesOn) {
  const auto feed = feed_of(2);
  ASSERT_NE(feed, nullptr);
  auto options = unprivileged(1.6);
  options.live = feed.get();
  std::mutex mutex;
  std::vector<std::string> said;
  options.on_notice = [&](const std::string& sentence) {
    const std::lock_guard lock(mutex);
    said.push_back(sentence);
  };
  const auto statistics = touch_headless(first_scene_of(*feed), options, {});
  ASSERT_TRUE(statistics) << statistics.error().sentence();
  const auto lost = [](const std::string& sentence) {
    return sentence.starts_with("No readable picture has come");
  };
  EXPECT_EQ(std::count_if(said.begin(), said.end(), lost), 1);
  EXPECT_GT(statistics->live->stale_s, 1.0);
  EXPECT_GT(statistics->servo.touch.ticks, 0U);
}

/// A source whose frames are all like this one.
class SameSource : public LiveSource {
 public:
  explicit SameSource(Raster<float> depth_m) : depth_m_(std::move(depth_m)) {}
  Result<std::optional<LiveFrame>> take(Clock::time_point) override {
    return std::optional(LiveFrame{next_++, Clock::now(), {depth_m_, {}}});
  }
  bool has_ended() const override { return false; }
  std::optional<Image> colour() override { return std::nullopt; }

 private:
  Raster<float> depth_m_;
  std::uint64_t next_ = 0;
};

/// A source that takes this long to read each frame after the first.
class SlowSource : public SameSource {
 public:
  explicit SlowSource(std::chrono::milliseconds reading)
      : SameSource(Raster<float>(80, 60, 1.0F)), reading_(reading) {}
  Result<std::optional<LiveFrame>> take(Clock::time_point deadline) override {
    const auto arrival = Clock::now();
    if (std::exchange(begun_, true)) std::this_thread::sleep_for(reading_);
    auto frame = SameSource::take(deadline);
    (*frame)->arrival = arrival;
    return frame;
  }

 private:
  std::chrono::milliseconds reading_;
  bool begun_ = false;
};

TEST(LiveFeed, SaysOnceThatTheSurfaceIsOldBecausePicturesAreReadTooSlowly) {
  LiveOptions live;
  live.lost_s = 0.3;
  // The one is said while the first of these pictures is still read.
  for (const int reading_ms : {400, 1200}) {
    const auto feed =
        LiveFeed::open(std::make_unique<SlowSource>(std::chrono::milliseconds(reading_ms)), live, {});
    ASSERT_TRUE(feed);
    auto options = unprivileged(1.5);
    options.live = feed->get();
    std::mutex mutex;
    std::vector<std::string> said;
    options.on_notice = [&](const std::string& sentence) {
      const std::lock_guard lock(mutex);
      said.push_back(sentence);
    };
    ASSERT_TRUE(touch_headless(first_scene_of(**feed), options, {}));
    const auto late = [](const std::string& sentence) { return sentence.starts_with("The surface is"); };
    EXPECT_EQ(std::count_if(said.begin(), said.end(), late), 1) << reading_ms;
    EXPECT_EQ(said.size(), 1U) << said.back();
  }
}

TEST(LiveFeed, RefusesASourceThatNeverShowsASurface) {
  LiveOptions options;
  options.first_s = 0.1;
  const auto of = [&](Raster<float> depth_m) {
    return LiveFeed::open(std::make_unique<SameSource>(std::move(depth_m)), options, {});
  };
  EXPECT_EQ(of(Raster<float>(8, 8, kUnknownDepth)).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(of(Raster<float>(1, 1, 1.0F)).error().code, ErrorCode::invalid_input);
  EXPECT_TRUE(of(Raster<float>(8, 8, 1.0F)));
}

TEST(LiveFeed, RefusesWrongOptionsAndAddresses) {
  LiveOptions options;
  options.fade_s = std::nan("");
  EXPECT_EQ(check(options).error().code, ErrorCode::usage);
  EXPECT_TRUE(is_live_address("camera:0"));
  EXPECT_FALSE(is_live_address("frames.palp"));
  EXPECT_EQ(open_live_source("robot:sample", {}, {}).error().code, ErrorCode::usage);
  EXPECT_EQ(open_live_source("frames:/nowhere", {}, {}).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(open_live_source("frames:/nowhere?fps=0", {}, {}).error().code, ErrorCode::usage);
  EXPECT_EQ(open_live_source("frames:/nowhere?speed=2", {}, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::session
