// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/live/camera_link.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palpable::sources {

/// The picture of a camera's frame, as decode_picture(). Errors (invalid_input, without a place): damaged,
/// more than kMostFramePixels, or fewer bytes than its size needs.
Result<Image> picture_of(const CameraFrame& frame);

/// The newest frame of one camera, read on a thread of its own; a camera that is lost is tried again.
template <class Frame>
class CameraStreamOf {
 public:
  /// How long after a loss the camera is tried again.
  static constexpr std::chrono::milliseconds kRetry{1000};

  /// Connects. `name`: the camera's address, for sentences. Errors: as `open`, with the name as the place.
  static Result<std::unique_ptr<CameraStreamOf>> open(OpenLinkOf<Frame> open, std::string name,
                                                      std::chrono::milliseconds retry = kRetry);
  ~CameraStreamOf();
  CameraStreamOf(const CameraStreamOf&) = delete;
  CameraStreamOf& operator=(const CameraStreamOf&) = delete;

  /// The newest frame that was not taken; waits for one until `deadline`. nullopt: none came. Errors: why the
  /// camera was lost before its first frame, with its name as the place.
  Result<std::optional<Frame>> take(std::chrono::steady_clock::time_point deadline);
  /// A sentence that the camera was lost, and why, if that is new: once for each loss.
  std::optional<std::string> loss();
  const std::string& name() const { return name_; }

 private:
  CameraStreamOf(OpenLinkOf<Frame> open, std::string name, std::chrono::milliseconds retry)
      : open_(std::move(open)), name_(std::move(name)), retry_(retry) {}
  void run(std::unique_ptr<CameraLinkOf<Frame>> link);
  Error follow(CameraLinkOf<Frame>& link);
  void lose(Error error);

  OpenLinkOf<Frame> open_;
  std::string name_;
  std::chrono::milliseconds retry_;
  /// The first number of the link that is open.
  std::uint64_t base_ = 0;
  std::atomic<bool> ending_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Frame> newest_;
  /// A frame came since the last loss; one ever came.
  bool is_here_ = false;
  bool came_ = false;
  std::optional<Error> lost_;
  std::optional<std::string> unsaid_;
  std::thread thread_;
};

using CameraStream = CameraStreamOf<CameraFrame>;
using DepthCameraStream = CameraStreamOf<DepthFrame>;
extern template class CameraStreamOf<CameraFrame>;
extern template class CameraStreamOf<DepthFrame>;

}  // namespace palpable::sources
