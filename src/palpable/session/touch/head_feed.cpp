// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/head_feed.hpp"

#include "palpable/session/touch/live_address.hpp"
#include "palpable/vision/depth_camera/head_finder.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;

/// A camera with the page's usual angle of view, for a source that states none.
Pinhole usual_camera(const Raster<float>& depth_m) {
  constexpr double kHalfAngle_rad = std::numbers::pi / 6.0;
  const double f = 0.5 * depth_m.width() / std::tan(kHalfAngle_rad);
  return {f, f, 0.5 * (depth_m.width() - 1), 0.5 * (depth_m.height() - 1), depth_m.width(), depth_m.height()};
}

}  // namespace

struct HeadFeed::Finding {
  vision::HeadFinder finder;
  /// Of the last picture, or of the moment at which it was followed.
  Clock::time_point pictured;
  bool is_missing = false;
  bool said_unreadable = false, said_lens = false;
};

HeadFeed::HeadFeed(std::unique_ptr<LiveSource> source)
    : source_(std::move(source)), finding_(std::make_unique<Finding>()), thread_([this] { run(); }) {}

HeadFeed::~HeadFeed() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  source_->cancel();
  thread_.join();
}

void HeadFeed::follow(bool follows, double down_rad) {
  down_rad_ = down_rad;
  {
    const std::lock_guard lock(mutex_);
    follows_ = follows;
    if (!follows) news_.reset();
  }
  wake_.notify_all();
}

std::optional<HeadNews> HeadFeed::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, std::nullopt);
}

std::optional<std::string> HeadFeed::take_notice() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notice_, std::nullopt);
}

void HeadFeed::put(const HeadNews& news) {
  const std::lock_guard lock(mutex_);
  if (follows_) news_ = news;
}

void HeadFeed::put_notice(std::string sentence) {
  const std::lock_guard lock(mutex_);
  notice_ = std::move(sentence);
}

/// False: this object ends.
bool HeadFeed::wait_until_followed() {
  std::unique_lock lock(mutex_);
  if (!follows_ && !ending_) {
    wake_.wait(lock, [this] { return follows_ || ending_; });
    // What was seen before is too old to be followed.
    finding_->finder = vision::HeadFinder();
    finding_->pictured = Clock::now();
    finding_->is_missing = false;
  }
  return !ending_;
}

void HeadFeed::run() {
  constexpr auto kPatience = std::chrono::milliseconds(100);
  while (wait_until_followed()) {
    const auto frame = source_->take(Clock::now() + kPatience);
    if (auto sentence = source_->notice()) put_notice(*std::move(sentence));
    if (!frame) {
      if (frame.error().code == ErrorCode::interrupted) return;
      if (!std::exchange(finding_->said_unreadable, true)) put_notice(frame.error().sentence());
    } else if (*frame) {
      look_at(**frame);
      continue;
    } else if (source_->has_ended()) {
      put({HeadNews::Pictures::ended, Clock::now(), {}});
      return;
    }
    if (auto sentence = source_->loss()) put_notice(*std::move(sentence));
    const std::chrono::duration<double> without = Clock::now() - finding_->pictured;
    if (without.count() > kMissing_s && !std::exchange(finding_->is_missing, true))
      put({HeadNews::Pictures::missing, Clock::now(), {}});
  }
}

void HeadFeed::look_at(const LiveFrame& frame) {
  finding_->pictured = frame.arrival;
  finding_->is_missing = false;
  const auto& depth_m = frame.depth.depth_m;
  if (!frame.depth.camera && !std::exchange(finding_->said_lens, true))
    put_notice("The depth camera that looks for your head states no angle of view: 60 degrees are assumed.");
  const vision::DownwardCamera camera{frame.depth.camera.value_or(usual_camera(depth_m)), down_rad_};
  HeadNews news{HeadNews::Pictures::come, frame.arrival, {}};
  if (const auto found = finding_->finder.find(depth_m, camera)) {
    // The camera looks at the viewer.
    const Vec3 eyes = found->eyes.v;
    news.head = SeenHead{{-eyes.x, -eyes.y, eyes.z}, found->heads};
  }
  put(news);
}

Result<std::unique_ptr<HeadFeed>> open_head_feed(const std::string& address, const Work& work) {
  const auto parsed = parse_live_address(address);
  if (!parsed) return parsed.error();
  const Error usage{
      ErrorCode::usage,
      "a head is looked for by a depth camera: frames:, openni:, freenect:, realsense: or ros:", "--head"};
  const bool is_depth = std::holds_alternative<FramesAddress>(*parsed) ||
                        std::holds_alternative<sources::DepthCamera>(*parsed) ||
                        std::holds_alternative<RosAddress>(*parsed);
  if (!is_depth) return usage;
  auto source = open_live_source(address, {}, work);
  if (!source) return std::move(source).error();
  // A folder may hold pairs.
  if (!(*source)->gives_depths()) return usage;
  return std::make_unique<HeadFeed>(*std::move(source));
}

}  // namespace palpable::session
