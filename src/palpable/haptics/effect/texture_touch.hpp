// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/effect/law_output.hpp"
#include "palpable/haptics/effect/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::haptics {

/// State of the texture in a touch: its label, and the share that is rendered, which grows smoothly. All zero
/// = none.
struct TextureTouch {
  std::uint16_t label;
  double share;
};

/// The contact point of a proxy, and the hand's depth below it.
struct TexturedPlace {
  Vec3 place_m;
  /// Outward unit normal.
  Vec3 normal;
  double depth_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

/// The height that a texture adds to the surface at a point, and its gradient along the surface.
struct TextureRise {
  double height_m = 0.0;
  Vec3 slope;
};

/// Projects a pattern onto a relief from above, so it is stretched on slopes. Tick path.
inline TextureRise on_plan(const models::TexturePattern& pattern, const TexturedPlace& at) noexcept {
  const models::HeightSample h = pattern.sample(at.place_m.x, at.place_m.y);
  const Vec3 over{h.dzdx, h.dzdy, 0.0};
  return {h.z_m, over - dot(over, at.normal) * at.normal};
}

/// Projects a pattern onto a solid along the three axes, weighted by how much the surface faces each axis
/// (triplanar mapping); on an axis-aligned face it is the pattern itself. The gradient ignores the change of
/// the weights along a curved surface. Tick path.
inline TextureRise on_solid(const models::TexturePattern& pattern, const TexturedPlace& at) noexcept {
  constexpr double kFaint = 1e-3;
  const Vec3 n2{at.normal.x * at.normal.x, at.normal.y * at.normal.y, at.normal.z * at.normal.z};
  const Vec3 faces{n2.x * n2.x, n2.y * n2.y, n2.z * n2.z};
  const double all = faces.x + faces.y + faces.z;
  TextureRise rise;
  Vec3 over;
  const auto add = [&](double face, double u_m, double v_m, auto&& laid) {
    const double share = face / all;
    if (!(share > kFaint)) return;
    const models::HeightSample h = pattern.sample(u_m, v_m);
    rise.height_m += share * h.z_m;
    over += laid(share * h.dzdx, share * h.dzdy);
  };
  const Vec3 p = at.place_m;
  add(faces.z, p.x, p.y, [](double u, double v) { return Vec3{u, v, 0.0}; });
  add(faces.x, p.y, p.z, [](double u, double v) { return Vec3{0.0, u, v}; });
  add(faces.y, p.z, p.x, [](double u, double v) { return Vec3{v, 0.0, u}; });
  rise.slope = over - dot(over, at.normal) * at.normal;
  return rise;
}

/// The effective depth for a texture, and its derivative with respect to the true depth.
struct TextureDepth {
  double value_m = 0.0;
  double slope = 1.0;
};

/// The true depth up to kTextureDepth_m; then it levels off, to at most kMaxTextureDepth_m. So the stiffness
/// that a texture adds, k·depth·h'', is bounded at any depth. Tick path.
inline TextureDepth texture_depth(double depth_m) noexcept {
  constexpr double kEase_m = 2.0 * (kMaxTextureDepth_m - kTextureDepth_m);
  if (depth_m <= kTextureDepth_m) return {depth_m, 1.0};
  const double slope = 1.0 - (depth_m - kTextureDepth_m) / kEase_m;
  if (slope <= 0.0) return {kMaxTextureDepth_m, 0.0};
  return {kMaxTextureDepth_m - 0.5 * kEase_m * slope * slope, slope};
}

/// Adds a texture of height h under the proxy, that is, a surface higher by h: the potential k·depth·h is
/// added, and its gradient to the force (height maps after Minsky 1995). The push is never cancelled
/// completely. `laid` is on_plan or on_solid; a null pattern adds nothing. Tick path.
template <class Laid>
void add_texture(const Hand& hand, const models::TexturePattern* pattern, const TexturedPlace& at,
                 Laid&& laid, TextureTouch& state, LawOutput& output) noexcept {
  constexpr double kEase_s = 0.010;
  constexpr double kWhole = 1.0 - 1e-6;
  if (pattern == nullptr) {
    state.share = 0.0;
    return;
  }
  if (state.label != output.label) state.share = 0.0;
  state.label = output.label;
  if (state.share < kWhole) state.share += hand.dt_s / (hand.dt_s + kEase_s) * (1.0 - state.share);
  if (!(at.depth_m > 0.0)) return;
  const double share =
      state.share * Textures::carried(hand.velocity_m_per_s.v, hand.dt_s, pattern->pitch_m());
  const TextureRise rise = laid(*pattern, at);
  const double k = share * at.stiffness_N_per_m;
  const TextureDepth depth = texture_depth(at.depth_m);
  const double higher_N = std::max(k * depth.slope * rise.height_m, -dot(output.force_N.v, at.normal));
  const Vec3 pushed_N = higher_N * at.normal - (k * depth.value_m) * rise.slope;
  output.force_N.v += pushed_N;
  output.spring_N.v += pushed_N;
  output.stored_J += k * depth.value_m * rise.height_m;
}

}  // namespace palpable::haptics
