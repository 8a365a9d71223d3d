// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/effect/route_pull.hpp"
#include "palpable/haptics/law/touchable.hpp"

#include <memory>
#include <utility>

namespace palpable::haptics {

/// Any law with a pull along a way added to its force. Shares its states with the law itself.
class GuidedTouchable final : public Touchable {
 public:
  /// `law` must not be null; `guide` must be valid; the scene reaches `half_size_m` from its origin.
  GuidedTouchable(std::shared_ptr<const Touchable> law, const models::RouteGuide& guide, Vec3 half_size_m)
      : law_(std::move(law)), pull_(guide, half_size_m) {}

  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    LawOutput output = law_->evaluate(hand, state);
    pull_.add(hand, state.pull, output);
    return output;
  }
  std::uint64_t state_family() const noexcept override { return law_->state_family(); }
  HandOver hand_over(const TouchState& state) const noexcept override { return law_->hand_over(state); }
  void take_over(const HandOver& from, TouchState& state) const noexcept override {
    law_->take_over(from, state);
  }
  TangentPlane tangent_plane(const Hand& hand, const TouchState& state) const noexcept override {
    return law_->tangent_plane(hand, state);
  }
  bool has_tangent_planes() const noexcept override { return law_->has_tangent_planes(); }
  EnergyModel energy_model() const noexcept override { return law_->energy_model(); }
  double damping_Ns_per_m() const noexcept override { return law_->damping_Ns_per_m(); }
  void touch_pages() const noexcept override;
  std::size_t memory_bytes() const noexcept override { return law_->memory_bytes() + pull_.memory_bytes(); }

 private:
  std::shared_ptr<const Touchable> law_;
  RoutePull pull_;
};

}  // namespace palpable::haptics
