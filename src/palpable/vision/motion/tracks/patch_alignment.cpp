// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/patch_alignment.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/numbers/vectorize.hpp"

#include <cmath>

#include <Eigen/LU>

namespace palpable::vision {
namespace {

// The least variance of a patch with texture, levels².
constexpr double kLeastVariance = 1.0;

struct AffineMap {
  float a, b, c, d, x, y;
};

// Bilinear; all places must lie inside the picture.
PALPABLE_VECTORIZE void sample_places(const std::uint8_t* __restrict picture, int width, AffineMap map,
                                      std::size_t count, const float* __restrict u, const float* __restrict v,
                                      float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float x = map.a * u[i] + map.b * v[i] + map.x, y = map.c * u[i] + map.d * v[i] + map.y;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
    const std::uint8_t* at = picture + (row * width + column);
    const float upper = static_cast<float>(at[0]) + right * static_cast<float>(at[1] - at[0]);
    const float lower = static_cast<float>(at[width]) + right * static_cast<float>(at[width + 1] - at[width]);
    out[i] = upper + down * (lower - upper);
  }
}

PALPABLE_VECTORIZE float product_sum(const float* __restrict a, const float* __restrict b,
                                     std::size_t count) {
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> sums{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += a[i + k] * b[i + k];
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

PatchTemplate::PatchTemplate(const Raster<std::uint8_t>& picture, ImagePoint centre,
                             const PatchOptions& options)
    : options_(options) {
  PALPABLE_CHECK(options.window_px % 2 == 1 && options.window_px >= 3 && options.window_px <= 31);
  fill_offsets();
  const PatchPlace place{centre};
  if (!sample(picture, place, 2, values_)) return;
  const auto difference = [&](double x, double y, Samples& out) {
    Samples before;
    sample(picture, {{centre.x - x, centre.y - y}}, 0, before);
    sample(picture, {{centre.x + x, centre.y + y}}, 0, out);
    for (std::size_t i = 0; i < count_; ++i) out[i] = 0.5F * (out[i] - before[i]);
  };
  Samples across, down;
  difference(1, 0, across);
  difference(0, 1, down);
  subtract_mean(values_);
  for (std::size_t i = 0; i < count_; ++i)
    variance_ += static_cast<double>(weight_[i] * values_[i] * values_[i]) / weight_sum_;
  if (variance_ < kLeastVariance) return;
  fill_derivatives(across, down);
  valid_ = inverse_.allFinite();
}

void PatchTemplate::fill_offsets() {
  const int radius = options_.window_px / 2;
  const double width = options_.weight_width * options_.window_px;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x) {
      u_[count_] = static_cast<float>(x), v_[count_] = static_cast<float>(y);
      const double weight = std::exp(-(x * x + y * y) / (2 * width * width));
      weight_[count_++] = static_cast<float>(weight);
      weight_sum_ += weight;
    }
}

bool PatchTemplate::sample(const Raster<std::uint8_t>& picture, const PatchPlace& place, int margin,
                           Samples& out) const {
  const auto& [a, b, c, d] = place.linear;
  const int radius = options_.window_px / 2;
  const double half_width = (std::abs(a) + std::abs(b)) * radius + margin,
               half_height = (std::abs(c) + std::abs(d)) * radius + margin;
  const auto& [x, y] = place.centre;
  if (!(x >= half_width && y >= half_height && x + half_width < picture.width() - 1 &&
        y + half_height < picture.height() - 1))
    return false;
  const AffineMap map{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c),
                      static_cast<float>(d), static_cast<float>(x), static_cast<float>(y)};
  sample_places(picture.data(), picture.width(), map, count_, u_.data(), v_.data(), out.data());
  return true;
}

void PatchTemplate::subtract_mean(Samples& values) const {
  const auto mean = static_cast<float>(
      static_cast<double>(product_sum(weight_.data(), values.data(), count_)) / weight_sum_);
  for (std::size_t i = 0; i < count_; ++i) values[i] -= mean;
}

void PatchTemplate::fill_derivatives(const Samples& across, const Samples& down) {
  for (std::size_t i = 0; i < count_; ++i) {
    const std::array<float, kUnknowns> row{
        across[i] * u_[i], across[i] * v_[i], down[i] * u_[i], down[i] * v_[i], across[i], down[i], 1.0F,
        values_[i]};
    for (std::size_t k = 0; k < kUnknowns; ++k) derivatives_[k][i] = row[k];
  }
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
  for (std::size_t r = 0; r < kUnknowns; ++r) {
    Samples weighted;
    for (std::size_t i = 0; i < count_; ++i) weighted[i] = weight_[i] * derivatives_[r][i];
    for (std::size_t c = 0; c < kUnknowns; ++c)
      normal(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          static_cast<double>(product_sum(weighted.data(), derivatives_[c].data(), count_));
  }
  const double radius = options_.window_px / 2, gradient = (normal(4, 4) + normal(5, 5)) / 2;
  for (int k = 0; k < 4; ++k) normal(k, k) += options_.stiffness * gradient * radius * radius;
  inverse_ = normal.inverse();
  for (Samples& column : derivatives_)
    for (std::size_t i = 0; i < count_; ++i) column[i] *= weight_[i];
}

bool PatchTemplate::align(const Raster<std::uint8_t>& picture, PatchPlace& place) const {
  const ImagePoint begin = place.centre;
  Samples rest;
  for (int k = 0; k < options_.most_iterations; ++k) {
    if (!sample(picture, place, 0, rest)) return false;
    subtract_mean(rest);
    for (std::size_t i = 0; i < count_; ++i) rest[i] -= values_[i];
    Unknowns right;
    for (std::size_t c = 0; c < kUnknowns; ++c)
      right[static_cast<Eigen::Index>(c)] =
          static_cast<double>(product_sum(derivatives_[c].data(), rest.data(), count_));
    const Unknowns step = inverse_ * right;
    // The picture there is the template, changed by `step`: the change is undone.
    const double contrast = 1 + step[7];
    Eigen::Matrix2d linear, change;
    linear << place.linear[0], place.linear[1], place.linear[2], place.linear[3];
    change << step[0], step[1], step[2], step[3];
    linear = linear * (Eigen::Matrix2d::Identity() + change / contrast).inverse();
    const Eigen::Vector2d moved = linear * step.segment<2>(4) / contrast;
    place.linear = {linear(0, 0), linear(0, 1), linear(1, 0), linear(1, 1)};
    place.centre.x -= moved.x(), place.centre.y -= moved.y();
    if (!(std::hypot(place.centre.x - begin.x, place.centre.y - begin.y) <= options_.farthest_px))
      return false;
    const double border_moved = change.norm() * options_.window_px / 2;
    if (moved.norm() >= options_.least_step_px || border_moved >= options_.least_border_step_px) continue;
    for (std::size_t i = 0; i < count_; ++i) rest[i] *= std::sqrt(weight_[i]);
    const double unlike =
        (static_cast<double>(product_sum(rest.data(), rest.data(), count_)) - right.dot(step)) / weight_sum_;
    return unlike <= (1 - options_.least_likeness) * variance_;
  }
  return false;
}

}  // namespace palpable::vision
