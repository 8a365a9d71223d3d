// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/half_window.hpp"

namespace palpable::hearing {

void HalfWindow::take(const std::vector<PairCorrelation>& pairs, const std::vector<Spectrum>& spectra,
                      std::span<const float> bin_power, std::span<const float> bin_weight) {
  for (std::size_t bin = 0; bin < bin_power.size(); ++bin) {
    power += double{bin_power[bin]};
    weight += double{bin_weight[bin]};
  }
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    const Spectrum &a = spectra[pairs[pair].first], &b = spectra[pairs[pair].second];
    for (std::size_t bin = 0; bin < bin_power.size(); ++bin) {
      const std::complex<float> product = a[bin] * std::conj(b[bin]);
      plain[pair][bin] += product;
      const float magnitude = std::abs(product);
      if (magnitude > 0.0F) whitened[pair][bin] += bin_weight[bin] / magnitude * product;
    }
  }
  ++frames;
}

}  // namespace palpable::hearing
