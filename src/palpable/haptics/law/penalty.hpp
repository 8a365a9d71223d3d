// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/models/field/distance_surface.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kPenaltyLaw;

/// `penalty`: f = -k min(D, 0) grad D, the exact gradient of k D^2 / 2 (Moustakas et al. 2007, sign
/// corrected), so without damping it makes no energy; and a damper, which never pulls along the normal. D is
/// a solid's distance, or minus the depth under a relief (ReliefDepth). Shaded, the gradient's length is left
/// out (force shading): nearly the same on an exact field, and not conservative. It pushes to the nearest
/// surface, so it pops through thin walls: `proxy` does not. On a field a ball of radius r is a point in the
/// field minus r; a relief is dilated by it. The papers' law on pictures, with the distance to the tangent
/// plane straight below the hand, is `averaged` without neighbours.
template <models::DistanceSurface Surface>
class PenaltyLaw : public ContactLaw<Surface> {
 public:
  struct State {};

  PenaltyLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, double radius_m, double shading)
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
    const Vec3 velocity = hand.velocity_m_per_s.v;
    output.force_N.v =
        damped_push(spring_N, outward, velocity, contact) +
        (1.0 - shading_) * drag(velocity - dot(velocity, outward) * outward, spring_N, contact);
    return output;
  }

  EnergyModel energy_model() const noexcept {
    return shading_ > 0.0 ? EnergyModel::none : EnergyModel::spring;
  }

 private:
  /// The spring's direction turns as the hand moves along the surface: held for a tick, that makes energy
  /// too, which a damper has to pay for. Never more than the push, so that a touch begins softly.
  static Vec3 drag(Vec3 along_m_per_s, double push_N, const Contact& contact) noexcept {
    const double speed = norm(along_m_per_s);
    if (speed * contact.damping_Ns_per_m <= push_N) return -contact.damping_Ns_per_m * along_m_per_s;
    return (-push_N / speed) * along_m_per_s;
  }

  double radius_m_;
  double shading_;
};

}  // namespace palpable::haptics
