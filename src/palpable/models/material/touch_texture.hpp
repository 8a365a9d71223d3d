// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace palpable::models {

/// Control values along a texture's side, and the finest periods of a picture along it.
inline constexpr int kTextureSide = 64;
inline constexpr int kPictureForms = 12;

/// A fine texture on a surface, too fine for the model: it is felt, not seen.
struct TouchTexture {
  enum class Kind : std::uint8_t {
    none,
    /// Irregular and isotropic.
    grain,
    /// Straight and parallel; at angle_rad = 0 they run along y.
    ridges,
    /// Rows of round bumps.
    bumps,
    /// Given by `tile`.
    picture
  };
  Kind kind = Kind::none;
  /// Period, 0.1 ... 20 mm.
  double pitch_m = 0.002;
  /// Amplitude, from the mean to the top, 0 ... 1 mm.
  double height_m = 30e-6;
  /// Rotation counter-clockwise.
  double angle_rad = 0.0;
  /// For Kind::picture: the periodic square, kTextureSide x kTextureSide control values −1 … 1 of a uniform
  /// cubic B-spline, rows from the top. It has at most kPictureForms periods per side; its side is
  /// kPictureForms · pitch_m.
  std::vector<float> tile = {};

  bool operator==(const TouchTexture&) const = default;
};

std::string_view name_of(TouchTexture::Kind kind);
std::optional<TouchTexture::Kind> texture_kind_from(std::string_view name);

/// Whether every value is finite and in range, and a picture has a tile.
bool is_valid(const TouchTexture& texture);

/// A texture for the tick: a periodic uniform cubic B-spline with 64 x 64 control values. Immutable; any
/// thread.
class TexturePattern {
 public:
  /// `texture` must be valid and not Kind::none.
  explicit TexturePattern(const TouchTexture& texture);

  /// Height relative to the surface (mean about 0) and its gradient, at any position within 1 km. Tick path.
  HeightSample sample(double x_m, double y_m) const noexcept;
  double pitch_m() const noexcept { return pitch_m_; }

 private:
  /// The square, padded with the repeated columns and rows that a query at its border reads.
  std::vector<float> values_;
  double pitch_m_;
  double cos_;
  double sin_;
  double samples_per_m_;
};

}  // namespace palpable::models
