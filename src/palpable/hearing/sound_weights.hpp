// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::hearing {

struct SoundWeightOptions {
  /// How fast a room's reverberation fades: its energy falls by 60 dB in this time.
  double reverberation_s = 0.5;
  /// The reverberant energy that a steady sound leaves, as a share of its own.
  double reverberation_share = 0.6;
  /// The noise in a bin is the least power of this time.
  double noise_memory_s = 1.5;
  /// Power below this many times the noise is noise.
  double noise_factor = 2.0;
  /// The weight of a bin that holds nothing but noise and reverberation: a steady sound is heard by these.
  double least_weight = 0.02;
};

/// How far each bin of a frame's spectrum is direct sound, after Valin, Michaud & Rouat (2007): the share of
/// its power beyond the noise and beyond the reverberation of what was heard before.
class SoundWeights {
 public:
  SoundWeights(std::size_t bins, double frames_per_s, const SoundWeightOptions& options);
  /// `power`: of the next frame, mean of the channels. Returns least_weight to 1 for each bin; the reference
  /// holds until the next call.
  std::span<const float> take(std::span<const float> power);

 private:
  SoundWeightOptions options_;
  double decay_ = 0.0;
  int frames_in_memory_ = 1;
  int frame_ = 0;
  std::vector<float> weights_, smooth_, least_before_, least_now_, reverberation_;
};

}  // namespace palpable::hearing
