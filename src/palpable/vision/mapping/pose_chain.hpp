// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/mapping/alignment.hpp"

#include <cstddef>
#include <vector>

namespace palpable::vision {

struct PoseChainOptions {
  /// A picture is kept when the camera has moved or turned by so much since the last one that is.
  double kept_m = 0.1;
  double kept_rad = 0.15;
  /// If there are more, every second one of the older half goes. 200 of 240 x 180 pixels are 33 MiB.
  std::size_t most_kept = 200;
};

/// A picture that a map was made of.
struct KeptPicture {
  PosedDepth posed;
  double time_s = 0.0;
  /// The drift up to it.
  PoseMatrix drift{};
};

/// The way of a camera as a chain of motions, each with its uncertainty, and pictures along it. When the
/// camera comes back to what it saw before, the error that shows is spread over the motions by their
/// uncertainty (as a Kalman smoother does), and a map can be made anew from the pictures. One thread.
class PoseChain {
 public:
  explicit PoseChain(const PoseChainOptions& options) : options_(options) {}

  /// The camera moved from one pose to the other; the error of that motion has this covariance.
  void move(const WorldPose& from, const WorldPose& to, const PoseMatrix& error);
  /// A picture at the newest pose.
  void keep(const PosedDepth& frame, double time_s);
  /// The covariance of the newest pose since the beginning, or since the last close().
  const PoseMatrix& drift() const { return drift_; }
  /// The camera, which the chain has at `newest`, is in truth at `found`: moves the pictures since the last
  /// close().
  void close(const WorldPose& newest, const WorldPose& found);
  /// In the order of their times.
  const std::vector<KeptPicture>& pictures() const { return pictures_; }

 private:
  void thin();

  PoseChainOptions options_;
  PoseMatrix drift_{};
  std::vector<KeptPicture> pictures_;
};

}  // namespace palpable::vision
