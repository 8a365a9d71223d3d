// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kRollingLaw;

/// `rolling`: the weight of a ball on the slope under the hand, f = -k_g grad z - k_v v (Shi & Pai 1997, eq.
/// 1). It uses the exact gradient, so without damping the force is the gradient of k_g z and does no work on
/// a closed path. In a servo loop the slope is taken at the position where the hand will be when the force
/// acts (Hand::acts_after_s). Otherwise a held and delayed force would lag behind the slope and generate
/// energy at each bend. The law ignores the hand's z, is always in contact, and acts in the plane.
template <models::HeightField Surface>
class RollingLaw {
 public:
  struct State {};

  RollingLaw(std::shared_ptr<const Surface> surface, double slope_force_N, double damping_Ns_per_m)
      : surface_(std::move(surface)), slope_force_N_(slope_force_N), damping_Ns_per_m_(damping_Ns_per_m) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept {
    const models::HeightSample here = surface_->sample(hand.position.v.x, hand.position.v.y);
    const Vec3 v = hand.velocity_m_per_s.v;
    const Vec3 ahead = hand.position.v + hand.acts_after_s * v;
    const models::HeightSample s = hand.acts_after_s > 0.0 ? surface_->sample(ahead.x, ahead.y) : here;
    LawOutput output;
    output.contact = true;
    output.stored_J = slope_force_N_ * here.z_m;
    output.spring_N.v = {-slope_force_N_ * here.dzdx, -slope_force_N_ * here.dzdy, 0.0};
    output.force_N.v = {-slope_force_N_ * s.dzdx - damping_Ns_per_m_ * v.x,
                        -slope_force_N_ * s.dzdy - damping_Ns_per_m_ * v.y, 0.0};
    return output;
  }

  EnergyModel energy_model() const noexcept { return EnergyModel::weight; }
  const Surface& surface() const noexcept { return *surface_; }
  double damping_Ns_per_m() const noexcept { return damping_Ns_per_m_; }
  std::size_t memory_bytes() const noexcept { return surface_->memory_bytes(); }

 private:
  std::shared_ptr<const Surface> surface_;
  double slope_force_N_;
  double damping_Ns_per_m_;
};

}  // namespace palpable::haptics
