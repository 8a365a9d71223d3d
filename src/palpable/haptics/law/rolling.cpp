// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/rolling.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <array>

namespace palpable::haptics {
namespace {

constexpr std::array kParameters{kSlopeForce, kPlaneDamping};

MadeLaw make(const LawInput& in) {
  const auto& relief = models::relief_of(in.scene);
  const LawParameters& p = in.parameters;
  return made_law(
      RollingLaw<models::Relief>(relief, value_or_preset(p, kSlopeForce), value_or_preset(p, kPlaneDamping)),
      mixed(static_cast<std::uint64_t>(p.law), content_hash(*relief)));
}

}  // namespace

constexpr LawDescription kRollingLaw{.law = Law::rolling,
                                     .name = "rolling",
                                     .title = "Rolling ball",
                                     .models = {true, true, true, true},
                                     .parameters = kParameters,
                                     .strength = &LawParameters::slope_force_N,
                                     .degrees_of_freedom = 2,
                                     .conservative = true,
                                     .make = make};

}  // namespace palpable::haptics
