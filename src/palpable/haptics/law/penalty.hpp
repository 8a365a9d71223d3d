// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/material_map.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace palpable::haptics {

/// The force of a spring that is pressed `depth_m` deep along `outward` (unit), with a damper, never pulling:
/// Park & Howard 2012, eq. 6, corrected.
inline Vec3 pressed(double depth_m, Vec3 outward, Vec3 velocity_m_per_s, const Contact& contact) noexcept {
  const double push =
      contact.stiffness_N_per_m * depth_m - contact.damping_Ns_per_m * dot(velocity_m_per_s, outward);
  return std::max(0.0, push) * outward;
}

/// `penalty`: spring and damper at the place straight below or above the hand, with the distance to the
/// surface's tangent plane there, d = (h - z) / sqrt(1 + |grad h|^2), as depth. Plain, the force is the exact
/// gradient of k d^2 / 2, so without damping it makes no energy; shaded, it points along the surface's normal
/// (Moustakas 2007, Gomez 2012), which feels smoother on rough ground and makes energy where the ground is
/// curved. It forgets on which side of a wall the hand came in, and in concave places its force changes
/// quickly from one wall's to the other's.
template <models::CurvedHeightField Surface>
class PenaltyLaw {
 public:
  struct State {};

  PenaltyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, bool shaded)
      : surface_(std::move(surface)), materials_(std::move(materials)), shaded_(shaded) {}

  Feel feel(const Hand& hand, State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::CurvedSample s = surface_->curved_sample(p.x, p.y);
    Feel feel;
    feel.label = materials_.label_at(p.x, p.y);
    feel.contact = p.z < s.z_m;
    if (!feel.contact) return feel;
    const double length2 = 1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy;
    const double length = std::sqrt(length2);
    const double depth = (s.z_m - p.z) / length;
    const Vec3 normal = Vec3{-s.dzdx, -s.dzdy, 1.0} / length;
    const Contact& contact = materials_.contact(feel.label);
    feel.force_N.v = pressed(depth, normal, hand.velocity_m_per_s.v, contact);
    if (!shaded_) {
      // -grad d is the normal and what the normal's own turning adds.
      const double turning = depth / length2;
      feel.force_N.v += contact.stiffness_N_per_m * depth * turning *
                        Vec3{s.dzdx * s.dzdxx_per_m + s.dzdy * s.dzdxy_per_m,
                             s.dzdx * s.dzdxy_per_m + s.dzdy * s.dzdyy_per_m, 0.0};
    }
    return feel;
  }

  const Surface& surface() const noexcept { return *surface_; }
  double damping_Ns_per_m() const noexcept { return materials_.contact(0).damping_Ns_per_m; }
  std::size_t memory_bytes() const noexcept { return surface_->memory_bytes() + materials_.memory_bytes(); }

 private:
  std::shared_ptr<const Surface> surface_;
  MaterialMap materials_;
  bool shaded_;
};

/// How `averaged` weighs its five places.
struct Averaging {
  double offset_m = 0.001;
  double neighbour_weight = 1.0;
  double centre_weight = 1.0;
};

/// `averaged`: as the shaded penalty, but the hand is projected onto the weighted mean of the surface below
/// it and below four neighbours at an offset, c = (w sum P_i + w_c C_1) / (4 w + w_c) (Gomez 2012, chapter
/// 12, its weights corrected). One smoothing step: concave places vibrate less, ridges are blunted, and it is
/// not conservative.
template <models::HeightField Surface>
class AveragedLaw {
 public:
  struct State {};

  AveragedLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, Averaging averaging)
      : surface_(std::move(surface)), materials_(std::move(materials)), averaging_(averaging) {}

  Feel feel(const Hand& hand, State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::HeightSample s = mean_at(p.x, p.y);
    Feel feel;
    feel.label = materials_.label_at(p.x, p.y);
    feel.contact = p.z < s.z_m;
    if (!feel.contact) return feel;
    const double length = std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
    feel.force_N.v = pressed((s.z_m - p.z) / length, Vec3{-s.dzdx, -s.dzdy, 1.0} / length,
                             hand.velocity_m_per_s.v, materials_.contact(feel.label));
    return feel;
  }

  const Surface& surface() const noexcept { return *surface_; }
  double damping_Ns_per_m() const noexcept { return materials_.contact(0).damping_Ns_per_m; }
  std::size_t memory_bytes() const noexcept { return surface_->memory_bytes() + materials_.memory_bytes(); }

 private:
  models::HeightSample mean_at(double x_m, double y_m) const noexcept {
    const auto [offset, w, centre] = averaging_;
    models::HeightSample mean;
    const auto add = [&](double x, double y, double weight) {
      const models::HeightSample s = surface_->sample(x, y);
      mean.z_m += weight * s.z_m;
      mean.dzdx += weight * s.dzdx;
      mean.dzdy += weight * s.dzdy;
    };
    const double share = 1.0 / (4.0 * w + centre);
    add(x_m, y_m, centre * share);
    add(x_m + offset, y_m, w * share);
    add(x_m - offset, y_m, w * share);
    add(x_m, y_m + offset, w * share);
    add(x_m, y_m - offset, w * share);
    return mean;
  }

  std::shared_ptr<const Surface> surface_;
  MaterialMap materials_;
  Averaging averaging_;
};

}  // namespace palpable::haptics
