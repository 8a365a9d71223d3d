// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/spectrum.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <bit>

#include <opencv2/core.hpp>

namespace palpable::hearing {

Spectrum spectrum_of(std::span<const float> samples) {
  PALPABLE_CHECK(!samples.empty() && samples.size() % 2 == 0);
  const cv::Mat in(1, static_cast<int>(samples.size()), CV_32F, const_cast<float*>(samples.data()));
  cv::Mat out;
  cv::dft(in, out, cv::DFT_COMPLEX_OUTPUT);
  const auto* bins = out.ptr<std::complex<float>>();
  return {bins, bins + samples.size() / 2 + 1};
}

std::vector<float> samples_of(const Spectrum& spectrum) {
  PALPABLE_CHECK(spectrum.size() >= 2);
  const std::size_t count = 2 * (spectrum.size() - 1);
  // OpenCV's packed form of the spectrum of real samples: re 0, re 1, im 1, ..., re n / 2.
  std::vector<float> packed(count);
  packed.front() = spectrum.front().real();
  packed.back() = spectrum.back().real();
  for (std::size_t bin = 1; bin + 1 < spectrum.size(); ++bin) {
    packed[2 * bin - 1] = spectrum[bin].real();
    packed[2 * bin] = spectrum[bin].imag();
  }
  std::vector<float> samples(count);
  cv::Mat out(1, static_cast<int>(count), CV_32F, samples.data());
  cv::dft(cv::Mat(1, static_cast<int>(count), CV_32F, packed.data()), out,
          cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return samples;
}

std::vector<float> convolved(std::span<const float> a, std::span<const float> b) {
  PALPABLE_CHECK(!a.empty() && !b.empty());
  const std::size_t length = a.size() + b.size() - 1;
  const std::size_t size = std::max<std::size_t>(2, std::bit_ceil(length));
  const auto padded = [size](std::span<const float> from) {
    std::vector<float> to(size);
    std::ranges::copy(from, to.begin());
    return spectrum_of(to);
  };
  Spectrum product = padded(a);
  const Spectrum other = padded(b);
  for (std::size_t bin = 0; bin < product.size(); ++bin) product[bin] *= other[bin];
  std::vector<float> out = samples_of(product);
  out.resize(length);
  return out;
}

}  // namespace palpable::hearing
