// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/contours/contour_channels.hpp"
#include "palpable/vision/contours/contour_steps.hpp"
#include "palpable/vision/contours/edge_response.hpp"
#include "palpable/vision/image/gaussian_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Scale of the derivatives that decide the direction, and of those on halved pictures.
constexpr double kScale_px = 2.0;
/// An ideal step's energy at any scale, over the spread of the picture around it (0.399 of 0.5).
constexpr float kEnergyOfStep = 0.8F;
/// Added before logarithms are taken.
constexpr float kFloor = 1e-6F;

/// Calls f(i) for every pixel, in parallel.
template <class F>
void each_pixel(const Work& work, std::size_t count, F f) {
  parallel_for(work, static_cast<int>(count), 1 << 14, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) f(i);
  });
}

cv::Mat as_mat(Raster<float>& r) { return {r.height(), r.width(), CV_32F, r.data()}; }

TensorMap zero_tensor(int width, int height) {
  return {Raster<float>(width, height), Raster<float>(width, height), Raster<float>(width, height)};
}

/// The rows of a gradient that contribute to a row of energy, and the output row.
struct EnergyRows {
  const float *gx, *gx_up, *gx_down, *gy, *gy_up, *gy_down;
  float *xx, *xy, *yy;
};

/// Adds odd g g^T + even H H for pixels from ... to - 1, with H from differences of g. The neighbours are
/// `left` and `right` pixels away, 0 at the picture's border.
PALPABLE_VECTORIZE
void add_energy_row(const EnergyRows& rows, int from, int to, int left, int right, float odd, float even) {
  const float* __restrict gx = rows.gx;
  const float* __restrict gy = rows.gy;
  const float* __restrict gx_up = rows.gx_up;
  const float* __restrict gx_down = rows.gx_down;
  const float* __restrict gy_up = rows.gy_up;
  const float* __restrict gy_down = rows.gy_down;
  float* __restrict xx = rows.xx;
  float* __restrict xy = rows.xy;
  float* __restrict yy = rows.yy;
  PALPABLE_INDEPENDENT
  for (int x = from; x < to; ++x) {
    const float hxx = 0.5F * (gx[x + right] - gx[x - left]);
    const float hyy = 0.5F * (gy_down[x] - gy_up[x]);
    const float hxy = 0.25F * (gx_down[x] - gx_up[x] + gy[x + right] - gy[x - left]);
    xx[x] += odd * gx[x] * gx[x] + even * (hxx * hxx + hxy * hxy);
    xy[x] += odd * gx[x] * gy[x] + even * hxy * (hxx + hyy);
    yy[x] += odd * gy[x] * gy[x] + even * (hyy * hyy + hxy * hxy);
  }
}

/// Square root of the larger eigenvalue of each tensor.
PALPABLE_VECTORIZE
void amplitude_row(const float* __restrict xx, const float* __restrict xy, const float* __restrict yy,
                   float* __restrict out, int count) {
  for (int x = 0; x < count; ++x) {
    const float difference = xx[x] - yy[x];
    const float spread = std::sqrt(difference * difference + 4.0F * xy[x] * xy[x]);
    const float twice = xx[x] + yy[x] + spread;
    out[x] = std::sqrt(0.5F * (twice > 0.0F ? twice : 0.0F));
  }
}

/// The channels at half size.
std::vector<WeightedChannel> halved(std::vector<WeightedChannel> channels) {
  std::vector<WeightedChannel> out;
  for (WeightedChannel& channel : channels) {
    Raster<float>& whole = channel.values;
    out.push_back({Raster<float>((whole.width() + 1) / 2, (whole.height() + 1) / 2), channel.weight});
    cv::Mat target = as_mat(out.back().values);
    cv::resize(as_mat(whole), target, target.size(), 0, 0, cv::INTER_AREA);
  }
  return out;
}

PALPABLE_VECTORIZE
void add_tensor_row(const float* __restrict gx, const float* __restrict gy, float weight,
                    float* __restrict xx, float* __restrict xy, float* __restrict yy, int count) {
  for (int x = 0; x < count; ++x) {
    xx[x] += weight * gx[x] * gx[x];
    xy[x] += weight * gx[x] * gy[x];
    yy[x] += weight * gy[x] * gy[x];
  }
}

/// Number of rows whose gradients are processed together while they are in the processor's caches.
constexpr int kStripe = 16;

/// Sums over channels for a stripe's pixels.
struct StripeEnergy {
  explicit StripeEnergy(int width) : xx(width, kStripe), xy(width, kStripe), yy(width, kStripe) {}
  Raster<float> xx, xy, yy;
};

/// Row `here` of a stripe's gradients with its neighbour rows, and row `to` of its energy.
EnergyRows rows_of(const Gradient& g, int here, int rows, int to, StripeEnergy& energy) {
  const int up = std::max(here - 1, 0);
  const int down = std::min(here + 1, rows - 1);
  return {g.x.row(here).data(),     g.x.row(up).data(),       g.x.row(down).data(),
          g.y.row(here).data(),     g.y.row(up).data(),       g.y.row(down).data(),
          energy.xx.row(to).data(), energy.xy.row(to).data(), energy.yy.row(to).data()};
}

/// Adds a row of one channel's energy: weight sigma^2 (g g^T + second^2 sigma^2 H H).
void add_energy(const EnergyRows& rows, int width, double sigma, float weight, float second) {
  const auto odd = static_cast<float>(sigma * sigma) * weight;
  const float even = odd * second * second * static_cast<float>(sigma * sigma);
  add_energy_row(rows, 0, 1, 0, std::min(1, width - 1), odd, even);
  add_energy_row(rows, 1, width - 1, 1, 1, odd, even);
  if (width > 1) add_energy_row(rows, width - 1, width, 1, 0, odd, even);
}

/// The energy's amplitude at one scale (square root of its tensor's larger eigenvalue) and optionally the sum
/// of the gradients' tensors. `second` is the weight of second derivatives.
Raster<float> energy_at(const std::vector<WeightedChannel>& channels, double sigma, float second,
                        const Work& work, TensorMap* tensors = nullptr) {
  Raster<float> out(channels[0].values.width(), channels[0].values.height());
  const int w = out.width();
  const int h = out.height();
  parallel_for(work, h, kStripe, [&](int begin, int end) {
    StripeEnergy energy(w);
    Gradient g{Raster<float>(w, kStripe + 2), Raster<float>(w, kStripe + 2)};
    for (int from = begin; from < end; from += kStripe) {
      const int past = std::min(from + kStripe, end);
      const int first = std::max(from - 1, 0);
      const int last = std::min(past + 1, h);
      for (Raster<float>* part : {&energy.xx, &energy.xy, &energy.yy})
        std::fill(part->values().begin(), part->values().end(), 0.0F);
      for (const WeightedChannel& channel : channels) {
        gaussian_gradient(channel.values, sigma, first, last, g);
        for (int y = from; y < past; ++y) {
          add_energy(rows_of(g, y - first, last - first, y - from, energy), w, sigma, channel.weight, second);
          if (tensors != nullptr)
            add_tensor_row(g.x.row(y - first).data(), g.y.row(y - first).data(), channel.weight,
                           tensors->xx.row(y).data(), tensors->xy.row(y).data(), tensors->yy.row(y).data(),
                           w);
        }
      }
      for (int y = from; y < past; ++y)
        amplitude_row(energy.xx.row(y - from).data(), energy.xy.row(y - from).data(),
                      energy.yy.row(y - from).data(), out.row(y).data(), w);
    }
  });
  return out;
}

/// Texture suppression: texture has strength on all sides, a boundary only along itself. Subtracts the mean
/// over a ring between the two sizes, at half resolution.
void subtract_texture(Raster<float>& strength, double inner_px, double outer_px) {
  constexpr int kCoarser = 2;
  cv::Mat s = as_mat(strength);
  cv::Mat small;
  cv::Mat inner;
  cv::Mat outer;
  cv::resize(s, small, cv::Size(std::max(1, s.cols / kCoarser), std::max(1, s.rows / kCoarser)), 0, 0,
             cv::INTER_AREA);
  cv::GaussianBlur(small, inner, {}, inner_px / kCoarser, 0, cv::BORDER_REFLECT);
  cv::GaussianBlur(small, outer, {}, outer_px / kCoarser, 0, cv::BORDER_REFLECT);
  const double in = inner_px * inner_px;
  const double out = outer_px * outer_px;
  cv::Mat ring = cv::max(0.0, outer * (out / (out - in)) - inner * (in / (out - in)));
  cv::resize(ring, ring, s.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat less = cv::max(0.0, s - ring);
  less.copyTo(s);
}

/// The weight of a scale for this picture, at most 1. If its energy is everywhere (speckle, film grain,
/// texture), its median is near its maximum; if it is sparse (clean contours), the median is near zero.
float weight_of(const Raster<float>& energy, const StandardContourOptions& options) {
  const std::size_t step = std::max<std::size_t>(1, energy.count() / 20000);
  std::vector<float> sample;
  for (std::size_t i = 0; i < energy.count(); i += step) sample.push_back(energy.values()[i]);
  const auto at = [&](double quantile) {
    const auto k =
        std::min(sample.size() - 1, static_cast<std::size_t>(quantile * static_cast<double>(sample.size())));
    std::nth_element(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(k), sample.end());
    return sample[k];
  };
  const float middle = at(0.5);
  const float high = at(options.energy_quantile);
  return high > 0.0F ? std::max(options.least_scale_share, 1.0F - options.grain_factor * middle / high)
                     : 1.0F;
}

/// The weighted geometric mean of the scales' energies, so that a boundary must be present at every scale
/// with weight.
Raster<float> mean_of(std::vector<Raster<float>>& energies, const std::vector<float>& shares,
                      const Work& work) {
  Raster<float> out(energies[0].width(), energies[0].height());
  const float total = std::accumulate(shares.begin(), shares.end(), 0.0F);
  parallel_for(work, out.height(), 16, [&](int begin, int end) {
    const cv::Range rows(begin, end);
    cv::Mat sum = as_mat(out).rowRange(rows);
    cv::Mat logarithm;
    for (std::size_t k = 0; k < energies.size(); ++k) {
      cv::log(as_mat(energies[k]).rowRange(rows) + kFloor, logarithm);
      cv::scaleAdd(logarithm, shares[k] / total, sum, sum);
    }
    cv::exp(sum, sum);
    sum = cv::max(sum - kFloor, 0.0);
  });
  return out;
}

Raster<float> enlarged(Raster<float> small, int width, int height) {
  Raster<float> out(width, height);
  cv::Mat target = as_mat(out);
  cv::resize(as_mat(small), target, target.size(), 0, 0, cv::INTER_LINEAR);
  return out;
}

/// Logarithm of the difference between both sides of each pixel, relative to the local standard deviation: 0
/// at an ideal step, much lower in grain and texture. `energy` is that of scale 2 px of these channels.
Raster<float> distinctness(const std::vector<WeightedChannel>& channels, const Raster<float>& energy,
                           const StandardContourOptions& options, const Work& work) {
  Raster<float> variance(energy.width(), energy.height());
  for (const WeightedChannel& channel : channels) {
    Raster<float> square = channel.values;
    for (float& v : square.values()) v *= v;
    square = gaussian_blur(square, options.spread_window_px, work);
    const Raster<float> mean = gaussian_blur(channel.values, options.spread_window_px, work);
    for (std::size_t i = 0; i < variance.count(); ++i) {
      const float m = mean.values()[i];
      variance.values()[i] += channel.weight * std::max(0.0F, square.values()[i] - m * m);
    }
  }
  Raster<float> out(energy.width(), energy.height());
  for (std::size_t i = 0; i < out.count(); ++i)
    out.values()[i] = std::log(
        (energy.values()[i] + kFloor) /
        (kEnergyOfStep * std::sqrt(variance.values()[i] + options.least_spread * options.least_spread)));
  return out;
}

/// Strength over scales 1, 2, 4 and 8 px (the last two on the picture halved once and twice) and, into
/// `direction`, the gradients' tensor of scale 2. The smaller the finest scale's weight, the more the
/// distinctness of the sides at 8, 16 and 32 px counts.
Raster<float> strength_of(std::vector<WeightedChannel> channels, const StandardContourOptions& options,
                          TensorMap& direction, float& fine_trust, const Work& work) {
  const int w = channels[0].values.width();
  const int h = channels[0].values.height();
  std::vector<Raster<float>> energies;
  const float second = options.second_derivative_weight;
  energies.push_back(energy_at(channels, 1.0, second, work));
  energies.push_back(energy_at(channels, kScale_px, second, work, &direction));
  fine_trust = weight_of(energies[0], options);
  const float exponent = std::min(options.distinctness_exponent, 1.0F - fine_trust);
  cv::Mat distinct(h, w, CV_32F, cv::Scalar(0.0));
  for (int times = 1; times <= (exponent > 0.0F ? 4 : 2); ++times) {
    channels = halved(std::move(channels));
    const Raster<float> energy = energy_at(channels, kScale_px, second, work);
    if (times <= 2) energies.push_back(enlarged(energy, w, h));
    if (times < 2 || exponent <= 0.0F) continue;
    Raster<float> enlarged_distinct = enlarged(distinctness(channels, energy, options, work), w, h);
    distinct += as_mat(enlarged_distinct);
  }
  std::vector<float> shares(options.scale_weights.begin(), options.scale_weights.end());
  for (std::size_t k = 0; k < shares.size(); ++k) shares[k] *= weight_of(energies[k], options);
  Raster<float> out = mean_of(energies, shares, work);
  if (exponent > 0.0F) {
    cv::exp(distinct * exponent, distinct);
    as_mat(out) = as_mat(out).mul(distinct);
  }
  return out;
}

}  // namespace

EdgeResponse standard_edges(const Image& image, const ContourOptions& options, const Work& work) {
  const StandardContourOptions& standard = options.standard;
  auto channels = edge_channels(image, options.channels, work);
  work.report(0.1, "finding boundaries");
  TensorMap t = zero_tensor(image.width, image.height);
  EdgeResponse out{Raster<float>(image.width, image.height), Raster<float>(image.width, image.height), {}};
  out.strength = strength_of(std::move(channels), standard, t, out.fine_trust, work);
  subtract_texture(out.strength, standard.texture_inner_px, standard.texture_outer_px);
  // In the averaged tensor both sides of a thin line agree; averaged gradients would cancel.
  for (Raster<float>* part : {&t.xx, &t.xy, &t.yy})
    *part = gaussian_blur(*part, standard.tensor_blur_px, work);
  each_pixel(work, out.strength.count(), [&](std::size_t i) {
    const float xx = t.xx.values()[i];
    const float xy = t.xy.values()[i];
    const float yy = t.yy.values()[i];
    float& s = out.strength.values()[i];
    s = s / (s + standard.half_contrast);
    if (xx + yy <= 1e-12F) return;
    // The normal's doubled angle is that of (xx - yy, 2 xy); the tangent's is opposite.
    std::tie(out.tangent_x.values()[i], out.tangent_y.values()[i]) = halve_angle(yy - xx, -2.0F * xy);
  });
  return out;
}

}  // namespace palpable::vision
