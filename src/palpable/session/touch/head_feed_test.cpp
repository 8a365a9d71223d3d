// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/head_feed.hpp"

#include "palpable/core/test_comes_true.hpp"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;
using Pictures = HeadNews::Pictures;

constexpr int kWidth = 160, kHeight = 120;
const Pinhole kCamera{140.0, 140.0, 79.5, 59.5, kWidth, kHeight};
/// In the camera's frame.
constexpr Vec3 kHead{0.1, -0.05, 0.8};

/// A head and shoulders of ellipsoids before a wall at 2 m.
DepthMap viewer(const std::optional<Pinhole>& camera) {
  DepthMap depth{Raster<float>(kWidth, kHeight, 2.0F), camera};
  const auto draw = [&](Vec3 middle, Vec3 half) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto by = [&](Vec3 p) { return Vec3{p.x / half.x, p.y / half.y, p.z / half.z}; };
        const Vec3 d = by({(x - kCamera.cx) / kCamera.fx, (y - kCamera.cy) / kCamera.fy, 1.0}),
                   o = by(middle);
        const double a = dot(d, d), b = dot(d, o), under = b * b - a * (dot(o, o) - 1.0);
        if (under < 0.0) continue;
        depth.depth_m(x, y) = std::min(depth.depth_m(x, y), static_cast<float>((b - std::sqrt(under)) / a));
      }
  };
  draw(kHead, {0.077, 0.115, 0.098});
  draw(kHead + Vec3{0.0, 0.15, 0.02}, {0.06, 0.09, 0.06});
  draw(kHead + Vec3{0.0, 0.32, 0.03}, {0.21, 0.12, 0.11});
  return depth;
}

/// Gives the viewer 50 times a second, until it ends or gives none.
class ViewerSource final : public LiveSource {
 public:
  explicit ViewerSource(std::optional<Pinhole> camera = kCamera) : camera_(camera) {}
  Result<std::optional<LiveFrame>> take(Clock::time_point deadline) override {
    ++taken;
    if (is_empty || has_ended()) {
      std::this_thread::sleep_until(deadline);
      return std::optional<LiveFrame>();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return std::optional(LiveFrame{number_++, Clock::now(), viewer(camera_), {}});
  }
  bool has_ended() const override { return ends; }
  std::optional<Image> colour() override {
    ++colours;
    return std::nullopt;
  }

  std::atomic<bool> is_empty = false, ends = false;
  std::atomic<int> taken = 0, colours = 0;

 private:
  std::optional<Pinhole> camera_;
  std::uint64_t number_ = 0;
};

/// Waits for news of this kind.
std::optional<HeadNews> news_of(HeadFeed& feed, Pictures kind) {
  std::optional<HeadNews> found;
  comes_true([&] {
    const auto news = feed.take_news();
    if (news && news->pictures == kind) found = news;
    return found.has_value();
  });
  return found;
}

TEST(HeadFeed, TellsWhereTheViewersEyesAreWhileSomebodyFollows) {
  auto owned = std::make_unique<ViewerSource>();
  ViewerSource& source = *owned;
  HeadFeed feed(std::move(owned));
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(source.taken, 0) << "nobody follows";
  feed.follow(true, 0.0);
  const auto news = news_of(feed, Pictures::come);
  ASSERT_TRUE(news && news->head);
  // The viewer's right is the camera's left; the eyes are before the head's middle, towards the camera.
  EXPECT_NEAR(news->head->eyes_m.x, -kHead.x * (1.0 - 0.083 / 0.8), 0.003);
  EXPECT_NEAR(news->head->eyes_m.y, -kHead.y + 0.004, 0.003);
  EXPECT_NEAR(news->head->eyes_m.z, kHead.z - 0.083, 0.003);
  EXPECT_EQ(news->head->heads, 1);
  EXPECT_EQ(source.colours, 0) << "no picture of the person is looked at";
  feed.follow(false, 0.0);
  EXPECT_FALSE(feed.take_news());
}

TEST(HeadFeed, TellsThatPicturesAreMissingAndThatTheyHaveEnded) {
  auto owned = std::make_unique<ViewerSource>();
  ViewerSource& source = *owned;
  HeadFeed feed(std::move(owned));
  source.is_empty = true;
  feed.follow(true, 0.0);
  ASSERT_TRUE(news_of(feed, Pictures::missing));
  source.is_empty = false;
  ASSERT_TRUE(news_of(feed, Pictures::come));
  source.ends = true;
  EXPECT_TRUE(news_of(feed, Pictures::ended));
}

TEST(HeadFeed, SaysThatTheCamerasAngleOfViewIsNotStated) {
  HeadFeed feed(std::make_unique<ViewerSource>(std::nullopt));
  feed.follow(true, 0.0);
  ASSERT_TRUE(news_of(feed, Pictures::come));
  const auto notice = feed.take_notice();
  ASSERT_TRUE(notice);
  EXPECT_NE(notice->find("60 degrees"), std::string::npos);
  EXPECT_FALSE(feed.take_notice());
}

TEST(HeadFeed, IsForDepthCamerasOnly) {
  for (const char* address : {"http://127.0.0.1/a", "robot:127.0.0.1", "camera:0", "nonsense:"}) {
    const auto opened = open_head_feed(address, {});
    ASSERT_FALSE(opened) << address;
    EXPECT_EQ(opened.error().code, ErrorCode::usage) << address;
  }
  EXPECT_FALSE(open_head_feed("frames:/no such folder", {}));
}

}  // namespace
}  // namespace palpable::session
