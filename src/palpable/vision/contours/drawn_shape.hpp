// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <functional>

// For tests only.
namespace palpable::vision {

/// Whether a point (pixels) is inside.
using Shape = std::function<bool(double x, double y)>;

/// Grey, 0.2 outside the shape and 0.8 inside, each pixel the mean of sub x sub samples of its square.
inline Image drawn(int size, const Shape& inside, int sub = 12) {
  Image image{size, size, 1, 16, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      int hits = 0;
      for (int k = 0; k < sub * sub; ++k)
        hits += inside(x + (k % sub + 0.5) / sub - 0.5, y + (k / sub + 0.5) / sub - 0.5) ? 1 : 0;
      image.samples.push_back(0.2F + 0.6F * static_cast<float>(hits) / static_cast<float>(sub * sub));
    }
  }
  return image;
}

}  // namespace palpable::vision
