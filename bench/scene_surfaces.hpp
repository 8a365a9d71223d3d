// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// The surfaces of rendered stereo scenes and their intersections with camera rays, in pixels of the left
// picture and disparities.
namespace palpable::bench {

inline constexpr int kSceneWidth = 320;
inline constexpr int kSceneHeight = 240;

using Colour = std::array<double, 3>;

/// Reproducible random numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// SplitMix64.
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  double unit() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }
  double between(double least, double most) { return least + (most - least) * unit(); }
  int count(int least, int most) { return least + static_cast<int>(unit() * (most - least + 1)); }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
  }

 private:
  std::uint64_t state_;
};

enum class Pattern { rough, plain, text, tiles, stripes };

struct Texture {
  Pattern pattern = Pattern::rough;
  Colour colour{0.5, 0.5, 0.5};
  /// How much the pattern changes the level.
  double contrast = 0.3;
  /// The size of a feature, or a pattern's period; px.
  double scale_px = 4.0;
  std::uint64_t seed = 0;

  /// The colour at a point of the left picture.
  Colour at(double x, double y) const;

 private:
  double level(double x, double y) const;
};

/// The outline of a planar surface in the left picture: a rotated rectangle or ellipse around (x, y).
struct Outline {
  enum class Shape { everywhere, rectangle, ellipse } shape = Shape::everywhere;
  double x = 0.0, y = 0.0, half_width = 0.0, half_height = 0.0;
  /// Of the rotation.
  double cosine = 1.0, sine = 0.0;

  Outline turned(double angle) const {
    Outline out = *this;
    out.cosine = std::cos(angle);
    out.sine = std::sin(angle);
    return out;
  }
  bool contains(double px, double py) const {
    if (shape == Shape::everywhere) return true;
    const double u = (cosine * (px - x) + sine * (py - y)) / half_width,
                 v = (cosine * (py - y) - sine * (px - x)) / half_height;
    return shape == Shape::rectangle ? std::abs(u) <= 1.0 && std::abs(v) <= 1.0 : u * u + v * v <= 1.0;
  }
};

/// A plane d = d0 + slope_x (x - x0) + slope_y (y - y0) inside an outline; or a ball or upright cylinder.
struct Surface {
  enum class Form { plane, ball, cylinder } form = Form::plane;
  double x0 = 0.0, y0 = 0.0, d0 = 0.0, slope_x = 0.0, slope_y = 0.0;
  Outline outline;
  double radius_px = 0.0;
  Texture texture;
};

/// The intersection of a camera ray with a surface: its disparity, and its position in the left picture.
struct Hit {
  double disparity_px = 0.0;
  double x = 0.0;
  std::size_t surface = 0;
};

/// The nearest intersection of a ray with the surfaces. camera_x: 0 for the left camera, 1 for the right one;
/// (x, y) is a point of its picture.
Hit first_hit(const std::vector<Surface>& surfaces, double camera_x, double x, double y);

}  // namespace palpable::bench
