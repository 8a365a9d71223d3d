// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/hearing/spectrum.hpp"
#include "palpable/hearing/steered_response.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::hearing {

/// Sums over the frames of half a window.
struct HalfWindow {
  HalfWindow(std::size_t pairs, std::size_t bins)
      : whitened(pairs, Spectrum(bins)), plain(pairs, Spectrum(bins)) {}

  /// The next frame: the channels' spectra, the mean of their powers, and the weights of the bins.
  void take(const std::vector<PairCorrelation>& pairs, const std::vector<Spectrum>& spectra,
            std::span<const float> bin_power, std::span<const float> bin_weight);

  /// For each pair: cross spectra of unit magnitude times their weights, and the plain ones.
  std::vector<Spectrum> whitened, plain;
  /// Sums over the frames and bins.
  double weight = 0.0, power = 0.0;
  int frames = 0;
};

}  // namespace palpable::hearing
