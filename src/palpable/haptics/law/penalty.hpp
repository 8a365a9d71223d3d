// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kPenaltyLaw;

/// `penalty`: spring and damper at the place straight below or above the hand, with the distance to the
/// surface's tangent plane there, d = (h - z) / sqrt(1 + |grad h|^2), as depth. Plain, the force is the exact
/// gradient of k d^2 / 2, so without damping it makes no energy; shaded, it points along the surface's normal
/// (Moustakas 2007, Gomez 2012), which feels smoother on rough ground and makes energy where the ground is
/// curved. It is kept as the papers give it, for comparison: it forgets on which side of a wall the hand came
/// in, and in concave places the plane turns so quickly that its force is many times the wall's own (docs/
/// laws.md has figures). `proxy` is the law to touch with.
template <models::CurvedHeightField Surface>
class PenaltyLaw : public ContactLaw<Surface> {
 public:
  struct State {};

  PenaltyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, double shading)
      : ContactLaw<Surface>(std::move(surface), std::move(materials)), shading_(shading) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::CurvedSample s = this->surface().curved_sample(p.x, p.y);
    LawOutput output;
    output.label = this->materials().label_at(p.x, p.y);
    output.contact = p.z < s.z_m;
    output.stored_J = 0.0;
    if (!output.contact) return output;
    const double length2 = 1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy;
    const double length = std::sqrt(length2);
    const double depth = (s.z_m - p.z) / length;
    const Vec3 normal = Vec3{-s.dzdx, -s.dzdy, 1.0} / length;
    const Contact& contact = this->materials().contact(output.label);
    const double spring_N = contact.stiffness_N_per_m * depth;
    output.force_N.v = damped_push(spring_N, normal, hand.velocity_m_per_s.v, contact);
    output.spring_N.v = spring_N * normal;
    output.stored_J = 0.5 * spring_N * depth;
    if (shading_ < 1.0) {
      // -grad d is the normal and what the normal's own turning adds.
      const double turning = (1.0 - shading_) * depth / length2;
      const Vec3 turned_N = contact.stiffness_N_per_m * depth * turning *
                            Vec3{s.dzdx * s.dzdxx_per_m + s.dzdy * s.dzdxy_per_m,
                                 s.dzdx * s.dzdxy_per_m + s.dzdy * s.dzdyy_per_m, 0.0};
      output.force_N.v += turned_N;
      output.spring_N.v += turned_N;
    }
    return output;
  }

  EnergyModel energy_model() const noexcept {
    return shading_ > 0.0 ? EnergyModel::none : EnergyModel::spring;
  }

 private:
  double shading_;
};

/// `penalty` on a solid: f = -k min(D, 0) grad D, the exact gradient of k D^2 / 2 (Moustakas et al. 2007,
/// sign corrected), so without damping it makes no energy; and a damper along the normal that never pulls.
/// Shaded, the gradient's length is left out (force shading): nearly the same on an exact field, and not
/// conservative. It pushes to the nearest surface, so it pops through thin walls: `proxy` does not. A ball of
/// radius r is a point in the field minus r.
template <models::DistanceSurface Surface>
class FieldPenaltyLaw : public ContactLaw<Surface> {
 public:
  struct State {};

  FieldPenaltyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, double radius_m,
                  double shading)
      : ContactLaw<Surface>(std::move(surface), std::move(materials)),
        radius_m_(radius_m),
        shading_(shading) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::FieldSample s = this->surface().sample(p);
    LawOutput output;
    output.label = this->materials().label_at(p.x, p.y);
    output.stored_J = 0.0;
    const double depth = radius_m_ - s.distance_m;
    output.contact = depth > 0.0;
    if (!output.contact) return output;
    const Contact& contact = this->materials().contact(output.label);
    output.stored_J = 0.5 * contact.stiffness_N_per_m * depth * depth;
    const double length = norm(s.gradient);
    if (!(length > 0.0)) return output;
    const Vec3 outward = s.gradient / length;
    output.spring_N.v = (contact.stiffness_N_per_m * depth) * s.gradient;
    const double spring_N = contact.stiffness_N_per_m * depth * (shading_ + (1.0 - shading_) * length);
    output.force_N.v = damped_push(spring_N, outward, hand.velocity_m_per_s.v, contact);
    return output;
  }

  EnergyModel energy_model() const noexcept {
    return shading_ > 0.0 ? EnergyModel::none : EnergyModel::spring;
  }

 private:
  double radius_m_;
  double shading_;
};

}  // namespace palpable::haptics
