// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/sound_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::hearing {

SoundWeights::SoundWeights(std::size_t bins, double frames_per_s, const SoundWeightOptions& options)
    : options_(options),
      decay_(std::pow(10.0, -6.0 / (frames_per_s * options.reverberation_s))),
      frames_in_memory_(std::max(1, static_cast<int>(0.5 * frames_per_s * options.noise_memory_s))),
      weights_(bins),
      smooth_(bins),
      least_before_(bins, std::numeric_limits<float>::max()),
      least_now_(bins, std::numeric_limits<float>::max()),
      reverberation_(bins) {}

std::span<const float> SoundWeights::take(std::span<const float> power) {
  // The least of smoothed powers is below their mean (Martin 2001); this factor is that of white noise.
  constexpr float kSmoothing = 0.7F, kLeastToMean = 1.8F;
  if (frame_++ % frames_in_memory_ == 0) {
    least_before_.swap(least_now_);
    std::ranges::fill(least_now_, std::numeric_limits<float>::max());
  }
  const auto least_weight = static_cast<float>(options_.least_weight);
  const auto noise_factor = static_cast<float>(options_.noise_factor);
  const auto decay = static_cast<float>(decay_);
  const auto share = static_cast<float>(options_.reverberation_share);
  for (std::size_t bin = 0; bin < weights_.size(); ++bin) {
    const float now = power[bin];
    smooth_[bin] = frame_ == 1 ? now : kSmoothing * smooth_[bin] + (1.0F - kSmoothing) * now;
    least_now_[bin] = std::min(least_now_[bin], smooth_[bin]);
    const float noise = kLeastToMean * std::min(least_now_[bin], least_before_[bin]);
    const float other = noise_factor * noise + reverberation_[bin];
    weights_[bin] = now > 0.0F ? std::max(least_weight, 1.0F - other / now) : 0.0F;
    reverberation_[bin] = decay * reverberation_[bin] + (1.0F - decay) * share * std::max(0.0F, now - noise);
  }
  return weights_;
}

}  // namespace palpable::hearing
