// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/tool.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <array>
#include <numbers>

namespace palpable::haptics {
namespace {

constexpr LawParameter kToolRadius{&LawParameters::tool_radius_m,
                                   "tool_radius_m",
                                   "Radius of the tool's end",
                                   "m",
                                   "tool-radius",
                                   0.0005,
                                   0.02,
                                   0.001,
                                   0.015,
                                   ToolShape{}.radius_m};
constexpr LawParameter kToolLength{&LawParameters::tool_length_m,
                                   "tool_length_m",
                                   "Length of the tool",
                                   "m",
                                   "tool-length",
                                   0.0,
                                   0.2,
                                   0.0,
                                   0.15,
                                   ToolShape{}.length_m};
constexpr std::array kParameters{kStiffness, kContactDamping, kToolRadius, kToolLength};

MadeLaw make(const LawInput& in) {
  ToolShape shape;
  shape.radius_m = value_or_preset(in.parameters, kToolRadius);
  shape.length_m = value_or_preset(in.parameters, kToolLength);
  return make_on_field(
      in, [&]<class S>(const std::shared_ptr<const S>& surface, MaterialMap materials, std::uint64_t family) {
        return made_law(ToolLaw<S>(surface, std::move(materials), shape),
                        mixed(mixed(family, shape.radius_m), shape.length_m));
      });
}

}  // namespace

std::vector<ToolPlace> tool_places(const ToolShape& shape) {
  auto places = cap_places(shape.radius_m, 0.5 * std::numbers::pi, shape.places);
  for (ToolPlace& tool : places) tool.place.v.z -= shape.length_m;
  return places;
}

constexpr LawDescription kToolLaw{.law = Law::tool,
                                  .name = "tool",
                                  .title = "Tool with an extent",
                                  .paper = "after Moustakas et al. 2007",
                                  .models = {.field = true},
                                  .parameters = kParameters,
                                  .strength = &LawParameters::stiffness_N_per_m,
                                  .degrees_of_freedom = 6,
                                  .conservative = true,
                                  .is_contact = true,
                                  .make = make};

}  // namespace palpable::haptics
