// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/regions.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace palpable::vision {
namespace {

/// Regions with sums of colour, known by the number that stands for their pixels.
class Forest {
 public:
  Forest(const Raster<Rgb8>& picture, double complexity)
      : pixels_(picture.count()), size_(picture.count(), 1), sum_(picture.count()), complexity_(complexity) {
    for (std::size_t i = 0; i < picture.count(); ++i) {
      const Rgb8 p = picture.values()[i];
      sum_[i] = {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
    }
    log_term_ = 2.0 * std::log(6.0 * static_cast<double>(picture.count()));
  }

  std::size_t region_of(std::size_t pixel) { return pixels_.find(pixel); }
  std::int32_t size_of(std::size_t region) const { return size_[region]; }

  void join_if_alike(std::int32_t one, std::int32_t other) {
    std::size_t a = region_of(static_cast<std::size_t>(one)), b = region_of(static_cast<std::size_t>(other));
    if (a == b || !alike(a, b)) return;
    // The smaller region is taken into the larger one, which keeps the paths short.
    if (size_[b] < size_[a]) std::swap(a, b);
    pixels_.join(a, b);
    size_[b] += size_[a];
    for (std::size_t k = 0; k < 3; ++k) sum_[b][k] += sum_[a][k];
  }

 private:
  /// The paper's b(R)²: the squared statistical deviation of a region's mean.
  double deviation(std::size_t root) const {
    constexpr double kLevels = 256.0;
    const double n = size_[root];
    return kLevels * kLevels / (2.0 * complexity_ * n) *
           (std::min(kLevels, n) * std::log(1.0 + n) + log_term_);
  }
  bool alike(std::size_t a, std::size_t b) const {
    const double allowed = deviation(a) + deviation(b);
    for (std::size_t k = 0; k < 3; ++k) {
      const double difference = sum_[a][k] / size_[a] - sum_[b][k] / size_[b];
      if (difference * difference > allowed) return false;
    }
    return true;
  }

  DisjointSets pixels_;
  std::vector<std::int32_t> size_;
  std::vector<std::array<double, 3>> sum_;
  double complexity_;
  double log_term_ = 0.0;
};

int difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// All pairs of neighbours, most similar first: a counting sort over the 256 possible differences.
std::vector<std::array<std::int32_t, 2>> neighbours_in_order(const Raster<Rgb8>& picture) {
  std::array<std::vector<std::array<std::int32_t, 2>>, 256> buckets;
  const auto put = [&](int x, int y, int x2, int y2) {
    const auto d = static_cast<std::size_t>(difference(picture(x, y), picture(x2, y2)));
    buckets[d].push_back({y * picture.width() + x, y2 * picture.width() + x2});
  };
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (x + 1 < picture.width()) put(x, y, x + 1, y);
      if (y + 1 < picture.height()) put(x, y, x, y + 1);
    }
  }
  std::vector<std::array<std::int32_t, 2>> pairs;
  pairs.reserve(2 * picture.count());
  for (const auto& bucket : buckets) pairs.insert(pairs.end(), bucket.begin(), bucket.end());
  return pairs;
}

}  // namespace

Regions merge_regions(const Raster<Rgb8>& picture, double complexity) {
  Forest forest(picture, complexity);
  for (const auto& [a, b] : neighbours_in_order(picture)) forest.join_if_alike(a, b);
  Regions regions{Raster<std::int32_t>(picture.width(), picture.height()), {}};
  std::vector<std::int32_t> number_of(picture.count(), -1);
  for (std::size_t i = 0; i < picture.count(); ++i) {
    const std::size_t region = forest.region_of(i);
    std::int32_t& number = number_of[region];
    if (number < 0) {
      number = regions.count();
      regions.pixels.push_back(forest.size_of(region));
    }
    regions.of_pixel.values()[i] = number;
  }
  return regions;
}

}  // namespace palpable::vision
