// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::draw {
namespace {

struct Linear {
  double r, g, b;
};

// Oklab to linear sRGB and back: the matrices of Björn Ottosson, "A perceptual color space" (2020).
Linear from_oklab(double lightness, double a, double b) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double decoded(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

bool in_gamut(Linear c) { return std::min({c.r, c.g, c.b}) >= 0.0 && std::max({c.r, c.g, c.b}) <= 1.0; }

/// The colour of this lightness and hue, with as much of the chroma as the screen can show.
Rgb8 colour(double lightness, double chroma, double hue_deg) {
  const double hue = hue_deg * std::numbers::pi / 180.0;
  const auto with = [=](double kept) {
    return from_oklab(lightness, kept * std::cos(hue), kept * std::sin(hue));
  };
  double shown = chroma;
  if (!in_gamut(with(chroma))) {
    double beyond = chroma;
    shown = 0.0;
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = 0.5 * (shown + beyond);
      (in_gamut(with(middle)) ? shown : beyond) = middle;
    }
  }
  const Linear c = with(shown);
  const auto to8 = [](double v) {
    return static_cast<std::uint8_t>(std::lround(255.0 * encoded(std::clamp(v, 0.0, 1.0))));
  };
  return {to8(c.r), to8(c.g), to8(c.b)};
}

double hue_at(double t) { return 280.0 - 175.0 * t; }

}  // namespace

Rgb8 depth_colour(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return colour(0.26 + 0.68 * u, 0.15, hue_at(u));
}

Rgb8 tint_colour(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return colour(0.70 + 0.26 * u, 0.055, hue_at(u));
}

double lightness(Rgb8 colour) {
  const double r = decoded(colour.r), g = decoded(colour.g), b = decoded(colour.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

}  // namespace palpable::draw
