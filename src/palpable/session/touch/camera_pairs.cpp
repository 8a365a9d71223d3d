// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/camera_pairs.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace palpable::session {
namespace {

using Clock = std::chrono::steady_clock;
using sources::CameraFrame;
using sources::CameraStream;

Result<Image> picture_of(const CameraStream& stream, const CameraFrame& frame) {
  auto picture = sources::picture_of(frame);
  if (!picture) picture.error().place = stream.name();
  return picture;
}

/// Both kinds of stereo camera.
class CameraPairs : public PairSource {
 public:
  Result<std::optional<LivePair>> take(Clock::time_point deadline) final {
    auto pair = next(deadline);
    constexpr auto kBeginning = std::chrono::seconds(3);
    if (pair || has_begun_ || Clock::now() - opened_ > kBeginning || is_lost(pair.error())) {
      has_begun_ = has_begun_ || (pair && *pair);
      return pair;
    }
    return std::optional<LivePair>();
  }
  bool has_ended() const final { return false; }

 protected:
  virtual Result<std::optional<LivePair>> next(Clock::time_point deadline) = 0;
  /// Takes a frame; an error is of the camera, not of its picture.
  Result<std::optional<CameraFrame>> frame_of(CameraStream& stream, Clock::time_point deadline) {
    auto frame = stream.take(deadline);
    if (!frame) lost_ = frame.error().message;
    return frame;
  }

 private:
  bool is_lost(const Error& error) const { return error.message == lost_; }

  Clock::time_point opened_ = Clock::now();
  bool has_begun_ = false;
  std::string lost_;
};

class SplitPairs final : public CameraPairs {
 public:
  SplitPairs(std::unique_ptr<CameraStream> camera, sources::StereoLayout layout)
      : camera_(std::move(camera)), layout_(layout) {}
  std::optional<std::string> loss() override { return camera_->loss(); }

 protected:
  Result<std::optional<LivePair>> next(Clock::time_point deadline) override {
    const auto frame = frame_of(*camera_, deadline);
    if (!frame) return frame.error();
    if (!*frame) return std::optional<LivePair>();
    const auto both = picture_of(*camera_, **frame);
    if (!both) return both.error();
    auto pair = sources::split_pair(*both, layout_);
    if (!pair) return Error{pair.error().code, pair.error().message, camera_->name()};
    return std::optional(
        LivePair{(*frame)->number, (*frame)->arrival, std::move(pair->left), std::move(pair->right)});
  }

 private:
  std::unique_ptr<CameraStream> camera_;
  sources::StereoLayout layout_;
};

class TwoCameras final : public CameraPairs {
 public:
  TwoCameras(std::unique_ptr<CameraStream> left, std::unique_ptr<CameraStream> right)
      : left_(std::move(left)), right_(std::move(right)) {}
  std::optional<std::string> loss() override {
    auto said = left_->loss();
    return said ? said : right_->loss();
  }

 protected:
  Result<std::optional<LivePair>> next(Clock::time_point deadline) override {
    constexpr auto kApart = std::chrono::milliseconds(100);
    for (const auto& [camera, newest] : {std::pair(left_.get(), &of_left_), {right_.get(), &of_right_}}) {
      // One that is kept waits for the other; a newer one takes its place.
      auto frame = frame_of(*camera, *newest ? Clock::now() : deadline);
      if (!frame) return std::move(frame).error();
      if (*frame) *newest = *std::move(frame);
      if (!*newest) return std::optional<LivePair>();
    }
    const auto behind = of_right_->arrival - of_left_->arrival;
    if (behind > kApart) of_left_.reset();
    if (behind < -kApart) of_right_.reset();
    if (!of_left_ || !of_right_) return std::optional<LivePair>();
    const auto frames = std::pair(*std::exchange(of_left_, {}), *std::exchange(of_right_, {}));
    return decoded(frames.first, frames.second);
  }

 private:
  Result<std::optional<LivePair>> decoded(const CameraFrame& left, const CameraFrame& right) const {
    auto left_picture = picture_of(*left_, left);
    if (!left_picture) return std::move(left_picture).error();
    auto right_picture = picture_of(*right_, right);
    if (!right_picture) return std::move(right_picture).error();
    return std::optional(LivePair{left.number, std::min(left.arrival, right.arrival),
                                  *std::move(left_picture), *std::move(right_picture)});
  }

  std::unique_ptr<CameraStream> left_, right_;
  std::optional<CameraFrame> of_left_, of_right_;
};

}  // namespace

std::unique_ptr<PairSource> camera_pairs(std::unique_ptr<CameraStream> left,
                                         std::unique_ptr<CameraStream> right, sources::StereoLayout layout) {
  if (right == nullptr) return std::make_unique<SplitPairs>(std::move(left), layout);
  return std::make_unique<TwoCameras>(std::move(left), std::move(right));
}

}  // namespace palpable::session
