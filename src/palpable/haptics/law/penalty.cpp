// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/penalty.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <array>

namespace palpable::haptics {
namespace {

constexpr std::array kParameters{kStiffness, kContactDamping, kRadius, kForceShading};

MadeLaw make(const LawInput& in) {
  const double shading = value_or_preset(in.parameters, kForceShading);
  if (models::is_field(in.scene.model))
    return make_on_field(in, [&]<class S>(const std::shared_ptr<const S>& surface, MaterialMap materials,
                                          std::uint64_t family) {
      return made_law(
          PenaltyLaw<S>(surface, std::move(materials), value_or_preset(in.parameters, kRadius), shading),
          family);
    });
  return make_on_relief(
      in, [&](std::shared_ptr<const models::Relief> surface, MaterialMap materials, std::uint64_t family) {
        using models::ReliefDepth;
        auto depth = ReliefDepth::under(std::move(surface), Work{});
        if (!depth) return MadeLaw{depth.error()};
        return made_law(PenaltyLaw<ReliefDepth>(std::make_shared<const ReliefDepth>(*std::move(depth)),
                                                std::move(materials), 0.0, shading),
                        family);
      });
}

}  // namespace

constexpr LawDescription kPenaltyLaw{.law = Law::penalty,
                                     .name = "penalty",
                                     .title = "Spring surface",
                                     .paper = "after Moustakas et al. 2007",
                                     .models = {.relief = true, .field = true},
                                     .parameters = kParameters,
                                     .strength = &LawParameters::stiffness_N_per_m,
                                     .conservative = true,
                                     .is_contact = true,
                                     .make = make};

}  // namespace palpable::haptics
