// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/depth_order.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace palpable::sculpt {
namespace {

double extent_of_values(const Raster<float>& values) {
  const auto [low, high] = std::minmax_element(values.values().begin(), values.values().end());
  return double{*high} - double{*low};
}

/// Draws places in the same order everywhere: the generator is specified exactly, unlike the standard
/// library's distributions.
class PlaceDraws {
 public:
  explicit PlaceDraws(const Raster<float>& of) : width_(of.width()), height_(of.height()) {}
  Pixel any() { return {below(width_), below(height_)}; }
  /// At most `reach` from `at` along each axis.
  Pixel near(Pixel at, int reach) {
    return {std::clamp(at.x + below(2 * reach + 1) - reach, 0, width_ - 1),
            std::clamp(at.y + below(2 * reach + 1) - reach, 0, height_ - 1)};
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

  int width_, height_;
  std::mt19937_64 random_{1};
};

/// Counts pairs and makes shares of them.
class OrderCount {
 public:
  OrderCount(double least_depth, double least_height)
      : least_depth_(least_depth), least_height_(least_height) {}
  void add(double nearer, double higher) {
    if (std::abs(nearer) <= least_depth_) return;
    ++pairs_;
    if (std::abs(higher) < least_height_ || higher == 0.0) return;
    ++((nearer > 0.0) == (higher > 0.0) ? kept_ : inverted_);
  }
  DepthOrder order() const {
    if (pairs_ == 0) return {};
    const auto share = [this](std::size_t n) { return static_cast<double>(n) / static_cast<double>(pairs_); };
    return {share(kept_), share(inverted_), share(pairs_ - kept_ - inverted_), pairs_};
  }

 private:
  double least_depth_, least_height_;
  std::size_t pairs_ = 0, kept_ = 0, inverted_ = 0;
};

}  // namespace

std::vector<Parameter> parameters_of(DepthOrderOptions& o) {
  return {
      {"pairs", &o.pairs, {100, 10'000'000}, "", "random pairs of places"},
      {"least_depth", &o.least_depth, {0, 1}, "", "share of the depth range from which a pair has an order"},
      {"least_height", &o.least_height, {0, 1}, "", "share of the height below which heights are equal"}};
}

DepthOrders depth_orders(const Raster<float>& nearness, const Raster<float>& height,
                         const DepthOrderOptions& options) {
  PALPABLE_CHECK(nearness.width() == height.width() && nearness.height() == height.height());
  if (nearness.empty()) return {};
  const double least_depth = options.least_depth * extent_of_values(nearness),
               least_height = options.least_height * extent_of_values(height);
  OrderCount anywhere(least_depth, least_height), nearby(least_depth, least_height);
  const int reach = std::max(
      1, static_cast<int>(std::lround(options.nearby * std::max(nearness.width(), nearness.height()))));
  PlaceDraws draws(nearness);
  const auto add = [&](OrderCount& count, Pixel a, Pixel b) {
    count.add(double{nearness(a.x, a.y)} - double{nearness(b.x, b.y)},
              double{height(a.x, a.y)} - double{height(b.x, b.y)});
  };
  for (int k = 0; k < options.pairs; ++k) {
    const Pixel a = draws.any();
    add(anywhere, a, draws.any());
    add(nearby, a, draws.near(a, reach));
  }
  return {anywhere.order(), nearby.order()};
}

}  // namespace palpable::sculpt
