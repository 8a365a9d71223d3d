// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

extern const LawDescription kRollingLaw;

/// A relief is smoothed by at most this much, the sigma of a Gaussian.
inline constexpr double kMostRollingSmoothing_m = 0.003;

/// What a loop and its device can render of a ball on slopes. The force of a bend of curvature c is a spring
/// of slope_force_N * c along the surface: in a valley it holds the ball, on a ridge it pushes it away.
struct RollingBounds {
  double max_stiffness_N_per_m = 0.0;
  double max_force_N = 0.0;
};

/// The force on a slope of 1, and how much the relief is smoothed.
struct RollingFit {
  double slope_force_N = 0.0;
  double smoothing_m = 0.0;
};

/// The nearest to `wanted` that keeps the bounds on every slope and bend of the scene: the relief is smoothed
/// as little as necessary; where kMostRollingSmoothing_m is not enough, the force is lowered. Bounds > 0.
/// Long work: up to a second for 4 million pixels.
RollingFit fit_rolling(const models::Scene& scene, const RollingFit& wanted, const RollingBounds& bounds);

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
