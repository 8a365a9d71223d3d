// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace palpable::models {

/// Control values along a texture's side; and the finest forms of a picture along it.
inline constexpr int kTextureSide = 64;
inline constexpr int kPictureForms = 12;

/// Fine forms on a surface, too fine for its model: felt, not seen.
struct TouchTexture {
  enum class Kind : std::uint8_t {
    none,
    /// Irregular, the same in all directions.
    grain,
    /// Straight and parallel; at angle_rad = 0 they run along y.
    ridges,
    /// Rows of round bumps.
    bumps,
    /// As its `tile` says.
    picture
  };
  Kind kind = Kind::none;
  /// From one form to the next, 0.1 ... 20 mm.
  double pitch_m = 0.002;
  /// From the middle to the top, 0 ... 1 mm.
  double height_m = 30e-6;
  /// Turned to the left by this.
  double angle_rad = 0.0;
  /// Of a picture: the square that repeats itself, kTextureSide x kTextureSide control values −1 … 1 of a
  /// uniform cubic B-spline, rows from the top, in which no form is finer than kPictureForms to the side. Its
  /// side is kPictureForms · pitch_m.
  std::vector<float> tile = {};

  bool operator==(const TouchTexture&) const = default;
};

std::string_view name_of(TouchTexture::Kind kind);
std::optional<TouchTexture::Kind> texture_kind_from(std::string_view name);

/// Every number finite and in its range, and a tile where it is a picture.
bool is_sound(const TouchTexture& texture);

/// A texture for the tick: one square that repeats itself for ever, as a uniform cubic B-spline of 64 x 64
/// control values. Immutable; any thread.
class TexturePattern {
 public:
  /// `texture` must be sound and not none.
  explicit TexturePattern(const TouchTexture& texture);

  /// Height above the surface's own (about 0 in the mean) and its gradient, at any place within 1 km. Tick
  /// path.
  HeightSample sample(double x_m, double y_m) const noexcept;
  double pitch_m() const noexcept { return pitch_m_; }

 private:
  /// The square, with the columns and rows again that a look at its border reads.
  std::vector<float> values_;
  double pitch_m_;
  double cos_;
  double sin_;
  double samples_per_m_;
};

}  // namespace palpable::models
