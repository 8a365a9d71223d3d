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
/// corrected), so the undamped force generates no energy; and a damper that never pulls along the normal. D
/// is the distance to a solid, or minus the depth below a relief (ReliefDepth). With force shading the length
/// of the gradient is omitted: nearly the same on an exact field, and not conservative. The force pushes
/// towards the nearest surface, so the hand can pop through thin walls, unlike with `proxy`. A ball of radius
/// r on a field is a point on the field minus r; a relief is dilated by the ball. The papers' law on
/// pictures, which uses the distance to the tangent plane below the hand, is `averaged` without neighbours.
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
    const models::FieldSample s = this->surface().sample(hand.position);
    LawOutput output;
    output.label = this->materials().label_at(p.x, p.y);
    output.stored_J = 0.0;
    const double penetration_m = radius_m_ - s.distance_m;
    output.contact = penetration_m > 0.0;
    if (!output.contact) return output;
    const Contact& contact = this->materials().contact(output.label);
    output.stored_J = 0.5 * contact.stiffness_N_per_m * penetration_m * penetration_m;
    const double length = norm(s.gradient);
    if (!(length > 0.0)) return output;
    const Vec3 outward = s.gradient.v / length;
    output.spring_N = (contact.stiffness_N_per_m * penetration_m) * s.gradient;
    const double spring_N =
        contact.stiffness_N_per_m * penetration_m * (shading_ + (1.0 - shading_) * length);
    const Vec3 velocity = hand.velocity_m_per_s.v;
    output.force_N.v =
        damped_push(spring_N, outward, velocity + speeds_up(hand, outward) * outward, contact) +
        (1.0 - shading_) * drag(velocity - dot(velocity, outward) * outward, spring_N, contact);
    return output;
  }

  TangentPlane tangent_plane(const Hand& hand, const State&) const noexcept {
    const Vec3 p = hand.position.v;
    const models::FieldSample s = this->surface().sample(hand.position);
    const double length = norm(s.gradient);
    if (!(length > 0.0)) return {};
    Contact contact = this->materials().contact(this->materials().label_at(p.x, p.y));
    contact.stiffness_N_per_m *= length * (shading_ + (1.0 - shading_) * length);
    return plane_above(p, (radius_m_ - s.distance_m) / length, s.gradient.v / length, contact);
  }

  EnergyModel energy_model() const noexcept {
    return shading_ > 0.0 ? EnergyModel::none : EnergyModel::spring;
  }

 private:
  /// The spring's direction changes as the hand moves along the surface. A force that is held for a tick then
  /// generates energy too, which this damper dissipates. It is at most the push, so that a contact begins
  /// softly.
  static Vec3 drag(Vec3 along_m_per_s, double push_N, const Contact& contact) noexcept {
    const double speed = norm(along_m_per_s);
    if (speed * contact.damping_Ns_per_m <= push_N) return -contact.damping_Ns_per_m * along_m_per_s;
    return (-push_N / speed) * along_m_per_s;
  }

  double radius_m_;
  double shading_;
};

}  // namespace palpable::haptics
