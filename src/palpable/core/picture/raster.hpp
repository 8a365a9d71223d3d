// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/check.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace palpable {

/// Column and row of an element of a grid.
struct Pixel {
  int x = 0, y = 0;
  bool operator==(const Pixel&) const = default;
};

/// A width x height grid of values, row-major, origin top-left. Owns its memory; a value type.
template <class T>
class Raster {
 public:
  Raster() = default;
  /// All values set to `fill`. Both sizes must be >= 0.
  Raster(int width, int height, T fill = T{})
      : width_(width), height_(height), values_(checked_count(width, height), fill) {}
  /// Takes values that exist, row by row from the top left. Both sizes must be >= 0, and there must be width
  /// x height values.
  Raster(int width, int height, std::vector<T> values)
      : width_(width), height_(height), values_(std::move(values)) {
    PALPABLE_CHECK(values_.size() == checked_count(width, height));
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t count() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  T& operator()(int x, int y) { return values_[index(x, y)]; }
  const T& operator()(int x, int y) const { return values_[index(x, y)]; }
  std::span<T> row(int y) { return {values_.data() + index(0, y), static_cast<std::size_t>(width_)}; }
  std::span<const T> row(int y) const {
    return {values_.data() + index(0, y), static_cast<std::size_t>(width_)};
  }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

  bool operator==(const Raster&) const = default;

 private:
  static std::size_t checked_count(int width, int height) {
    PALPABLE_CHECK(width >= 0 && height >= 0);
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> values_;
};

}  // namespace palpable
