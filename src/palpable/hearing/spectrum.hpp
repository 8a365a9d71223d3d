// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace palpable::hearing {

using Spectrum = std::vector<std::complex<float>>;

/// The discrete Fourier transform of real samples: the bins 0 to n / 2, without a factor. n is even, > 0.
Spectrum spectrum_of(std::span<const float> samples);

/// The real samples whose spectrum_of() is `spectrum`: 2 * (spectrum.size() - 1) of them.
std::vector<float> samples_of(const Spectrum& spectrum);

/// Linear convolution: a.size() + b.size() - 1 samples; neither is empty.
std::vector<float> convolved(std::span<const float> a, std::span<const float> b);

}  // namespace palpable::hearing
