// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/colour_planes.hpp"

#include "palpable/core/numbers/vectorize.hpp"

namespace palpable::vision {
namespace {

struct ColourRow {
  const std::uint8_t* r;
  const std::uint8_t* g;
  const std::uint8_t* b;

  ColourRow(const ColourPlanes& picture, int x, int y)
      : r(picture.r.row(y).data() + x), g(picture.g.row(y).data() + x), b(picture.b.row(y).data() + x) {}
};

std::uint8_t apart(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>(a > b ? a - b : b - a);
}

PALPABLE_VECTORIZE void differences_of_rows(const ColourRow& here, const ColourRow& there, int count,
                                            std::uint8_t* __restrict out) {
  const std::uint8_t* __restrict r0 = here.r;
  const std::uint8_t* __restrict g0 = here.g;
  const std::uint8_t* __restrict b0 = here.b;
  const std::uint8_t* __restrict r1 = there.r;
  const std::uint8_t* __restrict g1 = there.g;
  const std::uint8_t* __restrict b1 = there.b;
  for (int x = 0; x < count; ++x) {
    const std::uint8_t r = apart(r0[x], r1[x]);
    const std::uint8_t g = apart(g0[x], g1[x]);
    const std::uint8_t b = apart(b0[x], b1[x]);
    const std::uint8_t most = r > g ? r : g;
    out[x] = most > b ? most : b;
  }
}

}  // namespace

void colour_differences(const ColourPlanes& picture, int x0, int y0, int x1, int y1, int count,
                        std::uint8_t* differences) {
  if (count > 0) differences_of_rows({picture, x0, y0}, {picture, x1, y1}, count, differences);
}

}  // namespace palpable::vision
