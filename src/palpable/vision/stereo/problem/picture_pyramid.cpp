// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/picture_pyramid.hpp"

#include <algorithm>

namespace palpable::vision {
namespace {

Raster<Rgb8> halved(const Raster<Rgb8>& picture) {
  Raster<Rgb8> out((picture.width() + 1) / 2, (picture.height() + 1) / 2);
  const auto mean = [](int a, int b, int c, int d) {
    return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
  };
  for (int y = 0; y < out.height(); ++y) {
    const int v = std::min(2 * y + 1, picture.height() - 1);
    for (int x = 0; x < out.width(); ++x) {
      const int u = std::min(2 * x + 1, picture.width() - 1);
      const Rgb8 a = picture(2 * x, 2 * y);
      const Rgb8 b = picture(u, 2 * y);
      const Rgb8 c = picture(2 * x, v);
      const Rgb8 d = picture(u, v);
      out(x, y) = {mean(a.r, b.r, c.r, d.r), mean(a.g, b.g, c.g, d.g), mean(a.b, b.b, c.b, d.b)};
    }
  }
  return out;
}

Raster<std::uint8_t> luma(const Raster<Rgb8>& picture) {
  Raster<std::uint8_t> out(picture.width(), picture.height());
  for (std::size_t i = 0; i < out.count(); ++i) {
    const Rgb8 c = picture.values()[i];
    out.values()[i] = static_cast<std::uint8_t>((77 * c.r + 150 * c.g + 29 * c.b + 128) / 256);
  }
  return out;
}

}  // namespace

MatchInput halved(const MatchInput& input) {
  MatchInput out{halved(input.left),        halved(input.right),  {}, {},
                 input.disparities / 2 + 1, input.right_first / 2};
  out.left_grey = luma(out.left);
  out.right_grey = luma(out.right);
  return out;
}

}  // namespace palpable::vision
