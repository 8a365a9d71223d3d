// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/material/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::haptics {

/// Speed of the hand up to which a texture is fully rendered; faster strokes fade it out.
inline constexpr double kTextureSpeed_m_per_s = 0.1;
/// Least number of ticks per texture period. With half of it (Nyquist) the period would be aliased.
inline constexpr double kTicksPerForm = 4.0;

/// The smallest pitch that a loop can render at kTextureSpeed_m_per_s and a sensor can resolve: four ticks
/// and four sensor steps per period.
inline double min_pitch_m(double rate_hz, double position_resolution_m) noexcept {
  return std::max(kTicksPerForm * kTextureSpeed_m_per_s / rate_hz, 4.0 * position_resolution_m);
}

/// The force of a texture grows with the hand's depth up to kTextureDepth_m, and levels off at an effective
/// depth of kMaxTextureDepth_m (texture_depth()).
inline constexpr double kTextureDepth_m = 0.001;
inline constexpr double kMaxTextureDepth_m = 0.00125;

/// The greatest height of a texture. A texture adds a stiffness of k·depth·h'' to the wall's; at this height
/// it is half of the wall's at kTextureDepth_m.
inline double max_texture_height_m(double pitch_m) noexcept {
  constexpr double kTurn = 6.283185307179586;
  return 0.5 * pitch_m * pitch_m / (kTurn * kTurn * kTextureDepth_m);
}

/// Greatest ratio of the stiffness with this texture to that of the wall alone: 1 without a texture.
inline double texture_stiffening(const models::TouchTexture& texture) noexcept {
  if (texture.kind == models::TouchTexture::Kind::none) return 1.0;
  const double share = std::min(1.0, texture.height_m / max_texture_height_m(texture.pitch_m));
  return 1.0 + 0.5 * share * kMaxTextureDepth_m / kTextureDepth_m;
}

/// The textures of a scene's materials, prepared for the tick. Immutable.
class Textures {
 public:
  /// One material per label, at most 256. A texture higher than max_texture_height_m() is reduced to that
  /// height.
  explicit Textures(const std::vector<models::Material>& materials) {
    for (std::size_t k = 0; k < std::min(materials.size(), pattern_of_.size()); ++k) {
      models::TouchTexture texture = materials[k].texture;
      if (texture.kind == models::TouchTexture::Kind::none) continue;
      texture.height_m = std::min(texture.height_m, max_texture_height_m(texture.pitch_m));
      patterns_.emplace_back(texture);
      pattern_of_[k] = static_cast<std::uint16_t>(patterns_.size());
    }
  }

  bool any() const noexcept { return !patterns_.empty(); }
  /// The pattern of a label; null if it has none. Tick path.
  const models::TexturePattern* of(std::uint16_t label) const noexcept {
    const std::uint16_t number = pattern_of_[label & 0xFFU];
    return number > 0 ? &patterns_[number - 1U] : nullptr;
  }

  /// The share of a pattern that a loop can render at this speed: 1 up to a quarter of a period per tick, 0
  /// from half a period. Tick path.
  static double carried(Vec3 velocity_m_per_s, double dt_s, double pitch_m) noexcept {
    // Most strokes are slow and need no square root.
    const double reach2_m2 = kTicksPerForm * kTicksPerForm * dt_s * dt_s * squared_norm(velocity_m_per_s);
    if (reach2_m2 <= pitch_m * pitch_m) return 1.0;
    return std::max(0.0, 2.0 - std::sqrt(reach2_m2) / pitch_m);
  }

 private:
  std::vector<models::TexturePattern> patterns_;
  /// By label: 0 = none, else the index of the pattern, from 1.
  std::array<std::uint16_t, 256> pattern_of_{};
};

}  // namespace palpable::haptics
