// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/averaged.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <array>

namespace palpable::haptics {
namespace {

constexpr LawParameter kOffset{&LawParameters::averaging_offset_m,
                               "averaging_offset_m",
                               "Distance of the neighbours",
                               "m",
                               "averaging-offset",
                               0.0,
                               0.02,
                               0.0,
                               0.005,
                               0.001};
constexpr LawParameter kNeighbourWeight{&LawParameters::neighbour_weight,
                                        "neighbour_weight",
                                        "Weight of each neighbour",
                                        "",
                                        "neighbour-weight",
                                        0.0,
                                        1e6,
                                        0.0,
                                        5.0,
                                        1.0};
constexpr LawParameter kCentreWeight{&LawParameters::centre_weight,
                                     "centre_weight",
                                     "Weight of the centre",
                                     "",
                                     "centre-weight",
                                     0.0,
                                     1e6,
                                     0.0,
                                     5.0,
                                     1.0};
constexpr std::array kParameters{kStiffness, kContactDamping,  kRadius,
                                 kOffset,    kNeighbourWeight, kCentreWeight};

MadeLaw make(const LawInput& in) {
  const LawParameters& p = in.parameters;
  const Averaging averaging{value_or_preset(p, kOffset), value_or_preset(p, kNeighbourWeight),
                            value_or_preset(p, kCentreWeight)};
  if (averaging.neighbour_weight + averaging.centre_weight <= 0.0)
    return {usage_error("the weights of the law averaged must not both be 0")};
  return make_on_relief(in, [&](std::shared_ptr<const models::Relief> surface, MaterialMap materials,
                                std::uint64_t family) {
    return made_law(AveragedLaw<models::Relief>(std::move(surface), std::move(materials), averaging), family);
  });
}

}  // namespace

constexpr LawDescription kAveragedLaw{
    .law = Law::averaged,
    .name = "averaged",
    .title = "Averaged surface",
    .paper = "Gomez Aguinaga 2012, chapter 12",
    .models = {.relief = true},
    .parameters = kParameters,
    .strength = &LawParameters::stiffness_N_per_m,
    .is_contact = true,
    .contact_error =
        "within its offset (1 mm) of walls it pushes up to 4/5 of their height "
        "above the ground, and it meets spikes thinner than that up to 4/5 of "
        "their height late",
    .make = make};

}  // namespace palpable::haptics
