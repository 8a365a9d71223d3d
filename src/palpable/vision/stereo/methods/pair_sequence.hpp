// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstddef>

namespace palpable::vision {

struct PairSequenceOptions {
  /// Pictures are reduced to at most this many pixels; 64 ... 4 000 000.
  std::size_t most_pixels = 240 * 180;
  /// Disparities are searched up to the greatest of the previous pair, this share of it more, and four
  /// pixels; 0 ... 4.
  double growth = 0.25;
  /// The whole range is searched in the first pair and then in each one that this many others precede; 1 ...
  /// 10 000. So what comes near between two pairs is seen again.
  int search_every = 15;
};

/// The depth of rectified pairs that follow each other, by the method `fast`. One thread at a time.
class PairSequence {
 public:
  /// `options` within their ranges.
  explicit PairSequence(const PairSequenceOptions& options = {}) : options_(options) {}

  /// The depth of one more pair, whose rig is known, in the size that it was reduced to; unknown where the
  /// two pictures do not confirm each other, as beside edges. Errors: as match().
  Result<DepthMap> depth(const StereoPair& pair, const Work& work);
  /// The first pair showed that left and right are exchanged: the depths belong to the right pictures.
  bool exchanged() const { return exchanged_; }

 private:
  PairSequenceOptions options_;
  int since_search_ = 0;
  /// 0: there was no pair yet.
  int greatest_px_ = 0;
  int height_ = 0;
  bool exchanged_ = false;
};

/// Typical cameras, whose focal length is 0.9 of the pictures' width (58 degrees across), 60 mm apart: with
/// them only the proportions of depths are right.
StereoRig assumed_rig(int width, int height);

/// The same rig for pictures that were enlarged or reduced to another width.
StereoRig scaled(const StereoRig& rig, double factor);

}  // namespace palpable::vision
