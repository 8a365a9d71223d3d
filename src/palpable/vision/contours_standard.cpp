// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours_standard.hpp"

#include "palpable/vision/gaussian_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Second derivatives count this much beside first ones: between 0.58, above which a thin line has one ridge,
/// and 1, below which a step has one (second-order expansion of the energy about the centre of each).
constexpr float kEven = 1.0F;
/// Scale of the derivatives that decide the direction, and of the tensor's average.
constexpr double kDirectionScale_px = 2.0;
constexpr double kTensorAverage_px = 2.0;
/// Contrast, in the picture's range, that counts as strength one half.
constexpr float kHalfContrast = 0.12F;
/// Energies below this are nothing: it keeps logarithms finite.
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

/// Adds one channel's energy at one scale: sum of weight sigma^2 (g g^T + kEven^2 sigma^2 H H), H by
/// differences of g.
void add_energy(const Gradient& g, double sigma, float weight, TensorMap& out, const Work& work) {
  const auto odd = static_cast<float>(sigma * sigma) * weight;
  const float even = odd * kEven * kEven * static_cast<float>(sigma * sigma);
  const int w = g.x.width();
  const int h = g.x.height();
  parallel_for(work, h, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const int up = std::max(y - 1, 0);
      const int down = std::min(y + 1, h - 1);
      for (int x = 0; x < w; ++x) {
        const int left = std::max(x - 1, 0);
        const int right = std::min(x + 1, w - 1);
        const float gx = g.x(x, y);
        const float gy = g.y(x, y);
        const float hxx = 0.5F * (g.x(right, y) - g.x(left, y));
        const float hyy = 0.5F * (g.y(x, down) - g.y(x, up));
        const float hxy = 0.25F * (g.x(x, down) - g.x(x, up) + g.y(right, y) - g.y(left, y));
        out.xx(x, y) += odd * gx * gx + even * (hxx * hxx + hxy * hxy);
        out.xy(x, y) += odd * gx * gy + even * hxy * (hxx + hyy);
        out.yy(x, y) += odd * gy * gy + even * (hyy * hyy + hxy * hxy);
      }
    }
  });
}

void add_tensor(const Gradient& g, float weight, TensorMap& out, const Work& work) {
  each_pixel(work, g.x.count(), [&](std::size_t i) {
    const float gx = g.x.values()[i];
    const float gy = g.y.values()[i];
    out.xx.values()[i] += weight * gx * gx;
    out.xy.values()[i] += weight * gx * gy;
    out.yy.values()[i] += weight * gy * gy;
  });
}

/// Square root of the tensor's larger eigenvalue.
float amplitude(float xx, float xy, float yy) {
  const float spread = std::sqrt((xx - yy) * (xx - yy) + 4.0F * xy * xy);
  return std::sqrt(std::max(0.0F, 0.5F * (xx + yy + spread)));
}

Raster<float> amplitude_of(const TensorMap& t, const Work& work) {
  Raster<float> out(t.xx.width(), t.xx.height());
  each_pixel(work, out.count(), [&](std::size_t i) {
    out.values()[i] = amplitude(t.xx.values()[i], t.xy.values()[i], t.yy.values()[i]);
  });
  return out;
}

/// The channels at half size.
std::vector<WeightedChannel> halved(const std::vector<WeightedChannel>& channels) {
  std::vector<WeightedChannel> out;
  for (const WeightedChannel& channel : channels) {
    Raster<float> whole = channel.values;
    out.push_back({Raster<float>((whole.width() + 1) / 2, (whole.height() + 1) / 2), channel.weight});
    cv::Mat target = as_mat(out.back().values);
    cv::resize(as_mat(whole), target, target.size(), 0, 0, cv::INTER_AREA);
  }
  return out;
}

/// What one scale says: amplitude of its energy, and (where asked for) the sum of its gradients' tensors.
Raster<float> energy_at(const std::vector<WeightedChannel>& channels, double sigma, const Work& work,
                        TensorMap* gradients = nullptr) {
  TensorMap energy = zero_tensor(channels[0].values.width(), channels[0].values.height());
  for (const WeightedChannel& channel : channels) {
    const Gradient g = gaussian_gradient(channel.values, sigma, work);
    add_energy(g, sigma, channel.weight, energy, work);
    if (gradients != nullptr) add_tensor(g, channel.weight, *gradients, work);
  }
  return amplitude_of(energy, work);
}

/// Texture has strength on all sides, a boundary only along itself: takes off the mean of a ring of radius
/// about 4 … 24 px.
void take_off_texture(Raster<float>& strength) {
  constexpr double kInner_px = 2.0;
  constexpr double kOuter_px = 12.0;
  constexpr int kCoarser = 2;
  cv::Mat s = as_mat(strength);
  cv::Mat small;
  cv::Mat inner;
  cv::Mat outer;
  cv::resize(s, small, cv::Size(std::max(1, s.cols / kCoarser), std::max(1, s.rows / kCoarser)), 0, 0,
             cv::INTER_AREA);
  cv::GaussianBlur(small, inner, {}, kInner_px / kCoarser, 0, cv::BORDER_REFLECT);
  cv::GaussianBlur(small, outer, {}, kOuter_px / kCoarser, 0, cv::BORDER_REFLECT);
  const double in = kInner_px * kInner_px;
  const double out = kOuter_px * kOuter_px;
  cv::Mat ring = cv::max(0.0, outer * (out / (out - in)) - inner * (in / (out - in)));
  cv::resize(ring, ring, s.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat less = cv::max(0.0, s - ring);
  less.copyTo(s);
}

/// Scales' energies together: the weighted geometric mean, so that a boundary has to show at every scale; the
/// finest one weighs most, which keeps corners in their place. Sums of logarithms until strength_of.
void multiply_in(Raster<float>& logarithms, const Raster<float>& energy, float share, const Work& work) {
  each_pixel(work, energy.count(), [&](std::size_t i) {
    logarithms.values()[i] += share * std::log2(energy.values()[i] + kFloor);
  });
}

/// Strength over scales 1, 2 and 4 px (the last on the halved picture) and, into `direction`, the gradients'
/// tensor of scale 2.
Raster<float> strength_of(const std::vector<WeightedChannel>& channels, TensorMap& direction,
                          const Work& work) {
  const int w = channels[0].values.width();
  const int h = channels[0].values.height();
  Raster<float> sum(w, h);
  multiply_in(sum, energy_at(channels, 1.0, work), 0.5F, work);
  multiply_in(sum, energy_at(channels, kDirectionScale_px, work, &direction), 0.25F, work);
  Raster<float> coarse = energy_at(halved(channels), 2.0, work);
  Raster<float> whole(w, h);
  cv::Mat target = as_mat(whole);
  cv::resize(as_mat(coarse), target, target.size(), 0, 0, cv::INTER_LINEAR);
  multiply_in(sum, whole, 0.25F, work);
  each_pixel(work, sum.count(),
             [&](std::size_t i) { sum.values()[i] = std::max(0.0F, std::exp2(sum.values()[i]) - kFloor); });
  return sum;
}

}  // namespace

EdgeMap standard_edges(const Image& image, const Work& work) {
  const auto channels = edge_channels(image);
  work.report(0.1, "finding boundaries");
  TensorMap t = zero_tensor(image.width, image.height);
  EdgeMap out{Raster<float>(image.width, image.height), Raster<float>(image.width, image.height),
              strength_of(channels, t, work)};
  take_off_texture(out.strength);
  // The two sides of a thin line agree in the averaged tensor, where their gradients would cancel.
  for (Raster<float>* part : {&t.xx, &t.xy, &t.yy}) *part = gaussian_blur(*part, kTensorAverage_px, work);
  each_pixel(work, out.strength.count(), [&](std::size_t i) {
    const float xx = t.xx.values()[i];
    const float xy = t.xy.values()[i];
    const float yy = t.yy.values()[i];
    float& s = out.strength.values()[i];
    s = s / (s + kHalfContrast);
    if (xx + yy <= 1e-12F) return;
    // The normal's doubled angle is that of (xx - yy, 2 xy); the tangent's is opposite.
    std::tie(out.tangent_x.values()[i], out.tangent_y.values()[i]) = halve_angle(yy - xx, -2.0F * xy);
  });
  return out;
}

}  // namespace palpable::vision
