// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/median.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>

namespace palpable::vision {
namespace {

[[gnu::always_inline]] inline void order(float& a, float& b) {
  const float less = a < b ? a : b;
  b = a < b ? b : a;
  a = less;
}

/// A sorting network reduced to the median (Paeth 1990), so that a row can be vectorised.
PALPABLE_VECTORIZE void median_row(const float* __restrict above, const float* __restrict here,
                                   const float* __restrict below, int width, float* __restrict out) {
  for (int x = 1; x < width - 1; ++x) {
    float p0 = above[x - 1], p1 = above[x], p2 = above[x + 1];
    float p3 = here[x - 1], p4 = here[x], p5 = here[x + 1];
    float p6 = below[x - 1], p7 = below[x], p8 = below[x + 1];
    order(p1, p2), order(p4, p5), order(p7, p8);
    order(p0, p1), order(p3, p4), order(p6, p7);
    order(p1, p2), order(p4, p5), order(p7, p8);
    order(p0, p3), order(p5, p8), order(p4, p7);
    order(p3, p6), order(p1, p4), order(p2, p5);
    order(p4, p7), order(p4, p2), order(p6, p4);
    order(p4, p2);
    out[x] = p4;
  }
}

}  // namespace

Raster<float> median_3x3(const Raster<float>& values, const Work& work) {
  Raster<float> out = values;
  parallel_for(work, std::max(0, values.height() - 2), 16, [&](int begin, int end) {
    for (int y = begin + 1; y < end + 1; ++y)
      median_row(values.row(y - 1).data(), values.row(y).data(), values.row(y + 1).data(), values.width(),
                 out.row(y).data());
  });
  return out;
}

}  // namespace palpable::vision
