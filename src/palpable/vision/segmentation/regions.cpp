// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace palpable::vision {
namespace {

/// A union-find forest whose roots hold sums of colour.
class Forest {
 public:
  Forest(const Raster<Rgb8>& picture, double complexity)
      : parent_(picture.count()), size_(picture.count(), 1), sum_(picture.count()), complexity_(complexity) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t i = 0; i < picture.count(); ++i) {
      const Rgb8 p = picture.values()[i];
      sum_[i] = {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
    }
    log_term_ = 2.0 * std::log(6.0 * static_cast<double>(picture.count()));
  }

  std::int32_t root_of(std::int32_t i) {
    while (parent_[index(i)] != i) {
      parent_[index(i)] = parent_[index(parent_[index(i)])];
      i = parent_[index(i)];
    }
    return i;
  }
  std::int32_t size_of(std::int32_t root) const { return size_[index(root)]; }

  void join_if_alike(std::int32_t a, std::int32_t b) {
    a = root_of(a);
    b = root_of(b);
    if (a == b || !alike(index(a), index(b))) return;
    if (size_[index(a)] < size_[index(b)]) std::swap(a, b);
    parent_[index(b)] = a;
    size_[index(a)] += size_[index(b)];
    for (std::size_t k = 0; k < 3; ++k) sum_[index(a)][k] += sum_[index(b)][k];
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

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

  std::vector<std::int32_t> parent_;
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
    const std::int32_t root = forest.root_of(static_cast<std::int32_t>(i));
    std::int32_t& number = number_of[static_cast<std::size_t>(root)];
    if (number < 0) {
      number = regions.count();
      regions.pixels.push_back(forest.size_of(root));
    }
    regions.of_pixel.values()[i] = number;
  }
  return regions;
}

}  // namespace palpable::vision
