// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

/// `rolling`: the weight of a ball on the slope under the hand, f = -k_g grad z - k_v v (Shi & Pai 1997, eq.
/// 1), with the exact gradient, so that without damping it is the gradient of k_g z and does no work round a
/// closed path. Ignores the hand's z; always in contact; acts in the plane.
template <models::HeightField Surface>
class RollingLaw {
 public:
  struct State {};

  RollingLaw(std::shared_ptr<const Surface> surface, double weight_N, double damping_Ns_per_m)
      : surface_(std::move(surface)), weight_N_(weight_N), damping_Ns_per_m_(damping_Ns_per_m) {}

  Feel feel(const Hand& hand, State&) const noexcept {
    const models::HeightSample s = surface_->sample(hand.position.v.x, hand.position.v.y);
    const Vec3 v = hand.velocity_m_per_s.v;
    Feel feel;
    feel.contact = true;
    feel.stored_J = weight_N_ * s.z_m;
    feel.spring_N.v = {-weight_N_ * s.dzdx, -weight_N_ * s.dzdy, 0.0};
    feel.force_N.v = {-weight_N_ * s.dzdx - damping_Ns_per_m_ * v.x,
                      -weight_N_ * s.dzdy - damping_Ns_per_m_ * v.y, 0.0};
    return feel;
  }

  const Surface& surface() const noexcept { return *surface_; }
  double damping_Ns_per_m() const noexcept { return damping_Ns_per_m_; }
  std::size_t memory_bytes() const noexcept { return surface_->memory_bytes(); }

 private:
  std::shared_ptr<const Surface> surface_;
  double weight_N_;
  double damping_Ns_per_m_;
};

}  // namespace palpable::haptics
