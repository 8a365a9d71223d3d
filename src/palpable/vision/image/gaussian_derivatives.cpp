// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/gaussian_derivatives.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace palpable::vision {
namespace {

int reach(double sigma_px) { return static_cast<int>(std::ceil(4.5 * sigma_px)); }

/// Sixteen pixels of a row, unaligned.
constexpr int kLanes = 16;
using Lanes = float __attribute__((vector_size(sizeof(float) * kLanes)));
inline __attribute__((always_inline)) void get(const float* from, Lanes& to) {
  std::memcpy(&to, from, sizeof to);
}

/// The rows (or positions in a row) 0 … reach before and after the convolved one.
struct Neighbours {
  explicit Neighbours(std::size_t count) : behind(count), ahead(count) {}
  std::vector<const float*> behind;
  std::vector<const float*> ahead;
};

/// out[i] = taps[0] ahead[0][i], where even, plus sum_k taps[k] (ahead[k][i] + sign behind[k][i]) over n
/// pixels; sign 1 (even) or -1.
PALPABLE_VECTORIZE
void convolve(const float* const* behind, const float* const* ahead, const float* taps, int reach_px,
              float sign, int n, float* out) {
  const float centre = sign > 0.0F ? taps[0] : 0.0F;
  int i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    Lanes a, b;
    get(ahead[0] + i, a);
    Lanes sum = centre * a;
    for (int k = 1; k <= reach_px; ++k) {
      get(ahead[k] + i, a);
      get(behind[k] + i, b);
      sum += taps[k] * (a + sign * b);
    }
    std::memcpy(out + i, &sum, sizeof sum);
  }
  for (; i < n; ++i) {
    out[i] = centre * ahead[0][i];
    for (int k = 1; k <= reach_px; ++k) out[i] += taps[k] * (ahead[k][i] + sign * behind[k][i]);
  }
}

/// Both at once: smoothed with even taps, differentiated with odd ones.
PALPABLE_VECTORIZE
void convolve_both(const float* const* behind, const float* const* ahead, const float* even, const float* odd,
                   int reach_px, int n, float* smooth, float* derived) {
  int i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    Lanes a, b;
    get(ahead[0] + i, a);
    Lanes sum = even[0] * a;
    Lanes difference = {};
    for (int k = 1; k <= reach_px; ++k) {
      get(ahead[k] + i, a);
      get(behind[k] + i, b);
      sum += even[k] * (a + b);
      difference += odd[k] * (a - b);
    }
    std::memcpy(smooth + i, &sum, sizeof sum);
    std::memcpy(derived + i, &difference, sizeof difference);
  }
  for (; i < n; ++i) {
    smooth[i] = even[0] * ahead[0][i];
    derived[i] = 0.0F;
    for (int k = 1; k <= reach_px; ++k) {
      smooth[i] += even[k] * (ahead[k][i] + behind[k][i]);
      derived[i] += odd[k] * (ahead[k][i] - behind[k][i]);
    }
  }
}

/// The image's rows around row y; beyond its border the outermost is repeated.
void rows_around(const Raster<float>& image, int y, Neighbours& out) {
  for (std::size_t k = 0; k < out.ahead.size(); ++k) {
    const int step = static_cast<int>(k);
    out.ahead[k] = image.row(std::min(y + step, image.height() - 1)).data();
    out.behind[k] = image.row(std::max(y - step, 0)).data();
  }
}

/// A row padded with repeated values at both ends, and pointers to its shifted copies.
class PaddedRow {
 public:
  PaddedRow(int n, int reach_px)
      : around(static_cast<std::size_t>(reach_px) + 1),
        values_(static_cast<std::size_t>(n + 2 * reach_px)),
        reach_(reach_px) {
    for (int k = 0; k <= reach_px; ++k) {
      around.behind[static_cast<std::size_t>(k)] = begin() - k;
      around.ahead[static_cast<std::size_t>(k)] = begin() + k;
    }
  }
  PaddedRow(const PaddedRow&) = delete;
  PaddedRow& operator=(const PaddedRow&) = delete;

  float* begin() { return values_.data() + reach_; }
  void level_ends() {
    std::fill(values_.begin(), values_.begin() + reach_, *begin());
    std::fill(values_.end() - reach_, values_.end(), *(values_.end() - reach_ - 1));
  }

  Neighbours around;

 private:
  std::vector<float> values_;
  int reach_;
};

}  // namespace

std::vector<float> half_gaussian(double sigma_px) {
  const int r = reach(sigma_px);
  std::vector<double> g(static_cast<std::size_t>(r) + 1);
  double sum = 0.0;
  for (int k = 0; k <= r; ++k) {
    g[static_cast<std::size_t>(k)] = std::exp(-0.5 * k * k / (sigma_px * sigma_px));
    sum += (k == 0 ? 1.0 : 2.0) * g[static_cast<std::size_t>(k)];
  }
  std::vector<float> taps;
  taps.reserve(g.size());
  for (const double v : g) taps.push_back(static_cast<float>(v / sum));
  return taps;
}

std::vector<float> half_gaussian_derivative(double sigma_px) {
  const int r = reach(sigma_px);
  std::vector<double> d(static_cast<std::size_t>(r) + 1);
  double ramp = 0.0;
  for (int k = 0; k <= r; ++k) {
    d[static_cast<std::size_t>(k)] = k * std::exp(-0.5 * k * k / (sigma_px * sigma_px));
    ramp += 2.0 * k * d[static_cast<std::size_t>(k)];
  }
  std::vector<float> taps;
  taps.reserve(d.size());
  for (const double v : d) taps.push_back(static_cast<float>(v / ramp));
  return taps;
}

void gaussian_gradient(const Raster<float>& image, double sigma_px, int first, int last, Gradient& out) {
  const auto smooth = half_gaussian(sigma_px);
  const auto derive = half_gaussian_derivative(sigma_px);
  const int r = reach(sigma_px);
  const int n = image.width();
  Neighbours rows(smooth.size());
  PaddedRow even(n, r);
  PaddedRow odd(n, r);
  for (int y = first; y < last; ++y) {
    rows_around(image, y, rows);
    convolve_both(rows.behind.data(), rows.ahead.data(), smooth.data(), derive.data(), r, n, even.begin(),
                  odd.begin());
    even.level_ends();
    odd.level_ends();
    convolve(even.around.behind.data(), even.around.ahead.data(), derive.data(), r, -1.0F, n,
             out.x.row(y - first).data());
    convolve(odd.around.behind.data(), odd.around.ahead.data(), smooth.data(), r, 1.0F, n,
             out.y.row(y - first).data());
  }
}

Raster<float> gaussian_blur(const Raster<float>& image, double sigma_px, const Work& work) {
  const auto smooth = half_gaussian(sigma_px);
  const int r = reach(sigma_px);
  const int n = image.width();
  Raster<float> out(n, image.height());
  parallel_for(work, image.height(), 16, [&](int begin, int end) {
    Neighbours rows(smooth.size());
    PaddedRow padded(n, r);
    for (int y = begin; y < end; ++y) {
      rows_around(image, y, rows);
      convolve(rows.behind.data(), rows.ahead.data(), smooth.data(), r, 1.0F, n, padded.begin());
      padded.level_ends();
      convolve(padded.around.behind.data(), padded.around.ahead.data(), smooth.data(), r, 1.0F, n,
               out.row(y).data());
    }
  });
  return out;
}

}  // namespace palpable::vision
