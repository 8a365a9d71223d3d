// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "scene_surfaces.hpp"

#include <algorithm>
#include <optional>

namespace palpable::bench {
namespace {

/// The cameras: focal length in pixels, baseline 1, so that disparity = kFocal_px / depth.
constexpr double kFocal_px = 320.0;

double hash_at(std::int64_t i, std::int64_t j, std::uint64_t kind) {
  return Random(static_cast<std::uint64_t>(i) * 0x9E3779B1U ^
                static_cast<std::uint64_t>(j) * 0xC2B2AE3D27D4EB4FU ^ kind * 0x165667B19E3779F9U)
      .unit();
}

/// Smooth noise of about one feature per unit, 0 … 1.
double value_noise(double u, double v, std::uint64_t kind) {
  const double i = std::floor(u), j = std::floor(v);
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double s = smooth(u - i), t = smooth(v - j);
  const auto at = [&](int di, int dj) {
    return hash_at(static_cast<std::int64_t>(i) + di, static_cast<std::int64_t>(j) + dj, kind);
  };
  const double top = at(0, 0) + s * (at(1, 0) - at(0, 0));
  const double bottom = at(0, 1) + s * (at(1, 1) - at(0, 1));
  return top + t * (bottom - top);
}

/// The disparity at which a ray meets a surface; as first_hit().
std::optional<double> disparity_along(const Surface& s, double camera_x, double x, double y) {
  if (s.form == Surface::Form::plane) {
    // A ray of the right camera meets the plane where x_left = x + d.
    const double d = (s.d0 + s.slope_x * (x - s.x0) + s.slope_y * (y - s.y0)) / (1.0 - camera_x * s.slope_x);
    if (d <= 0.1 || !s.outline.contains(x + camera_x * d, y)) return std::nullopt;
    return d;
  }
  // The centre lies at the depth of d0; the ray is (camera_x, 0, 0) + t (u, v, 1), t being the depth.
  const double depth = kFocal_px / s.d0, r = s.radius_px / s.d0;
  const double cx = (s.x0 - kSceneWidth / 2.0) / s.d0 - camera_x, cy = (s.y0 - kSceneHeight / 2.0) / s.d0;
  const double u = (x - kSceneWidth / 2.0) / kFocal_px, v = (y - kSceneHeight / 2.0) / kFocal_px;
  const bool ball = s.form == Surface::Form::ball;
  const double a = u * u + 1.0 + (ball ? v * v : 0.0), b = u * cx + depth + (ball ? v * cy : 0.0),
               c = cx * cx + depth * depth + (ball ? cy * cy : 0.0) - r * r;
  const double root = b * b - a * c;
  if (root < 0.0) return std::nullopt;
  const double t = (b - std::sqrt(root)) / a;
  if (t <= 0.0) return std::nullopt;
  const double d = kFocal_px / t;
  return s.outline.contains(x + camera_x * d, y) ? std::optional(d) : std::nullopt;
}

}  // namespace

Colour Texture::at(double x, double y) const {
  const double shade = pattern == Pattern::plain ? contrast * (value_noise(x / 90.0, y / 90.0, seed) - 0.5)
                                                 : contrast * level(x, y);
  Colour out = colour;
  for (std::size_t c = 0; c < 3; ++c)
    out[c] =
        std::clamp(out[c] + shade * (0.8 + 0.4 * hash_at(static_cast<std::int64_t>(c), 7, seed)), 0.0, 1.0);
  return out;
}

double Texture::level(double x, double y) const {
  const double u = x / scale_px, v = y / scale_px;
  const double grain = 0.15 * (value_noise(u * 2.1, v * 2.1, seed + 5) - 0.5);
  switch (pattern) {
    case Pattern::tiles: {
      const bool joint = u - std::floor(u) < 0.15 || v - std::floor(v) < 0.15;
      return (joint ? -0.6 : 0.3) + grain;
    }
    case Pattern::stripes:
      return 0.5 * std::sin(2.0 * 3.14159265358979 * u) + grain;
    case Pattern::text: {
      // Lines of signs that repeat every five: each sign is a 4 x 6 bitmap.
      const auto line = static_cast<std::int64_t>(std::floor(v / 1.6));
      const double in_line = v / 1.6 - static_cast<double>(line);
      const auto sign = static_cast<std::int64_t>(std::floor(u));
      if (in_line > 0.62) return 0.3 + grain;
      const auto column = static_cast<std::int64_t>((u - std::floor(u)) * 4.99);
      const auto row = static_cast<std::int64_t>(in_line / 0.62 * 6.0);
      const std::int64_t letter = ((sign % 5) + 5) % 5;
      return (column < 4 && hash_at(letter * 8 + column, row, seed) > 0.5 ? -0.7 : 0.3) + grain;
    }
    default:
      return 0.6 * (value_noise(u, v, seed) - 0.5) + 0.5 * (value_noise(u * 2.3, v * 2.3, seed + 1) - 0.5) +
             0.4 * (value_noise(u / 5.0, v / 5.0, seed + 2) - 0.5);
  }
}

Hit first_hit(const std::vector<Surface>& surfaces, double camera_x, double x, double y) {
  Hit hit;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto d = disparity_along(surfaces[i], camera_x, x, y);
    if (d && *d > hit.disparity_px) hit = {*d, x + camera_x * *d, i};
  }
  return hit;
}

}  // namespace palpable::bench
