// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/proxy.hpp"

#include "palpable/haptics/law/field_proxy.hpp"
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <array>

namespace palpable::haptics {
namespace {

constexpr std::array kParameters{kStiffness, kContactDamping, kStaticFriction, kDynamicFriction, kRadius};

}  // namespace

MadeLaw make_proxy(const LawInput& in) {
  Textures textures(in.scene.materials);
  if (models::is_field(in.scene.model))
    return make_on_field(in, [&]<class S>(const std::shared_ptr<const S>& surface, MaterialMap materials,
                                          std::uint64_t family) {
      return made_law(FieldProxyLaw<S>(surface, std::move(materials), value_or_preset(in.parameters, kRadius),
                                       std::move(textures)),
                      family);
    });
  return make_on_relief(
      in, [&](std::shared_ptr<const models::Relief> surface, MaterialMap materials, std::uint64_t family) {
        using Bounded = models::BoundedRelief;
        return made_law(ProxyLaw<Bounded>(std::make_shared<const Bounded>(std::move(surface)),
                                          std::move(materials), std::move(textures)),
                        family);
      });
}

constexpr LawDescription kProxyLaw{.law = Law::proxy,
                                   .name = "proxy",
                                   .title = "Surface with friction",
                                   .paper = "Zilles & Salisbury 1995; Ruspini, Kolarov & Khatib 1997",
                                   .models = {.relief = true, .field = true},
                                   .parameters = kParameters,
                                   .strength = &LawParameters::stiffness_N_per_m,
                                   .conservative = true,
                                   .is_contact = true,
                                   .renders_textures = true,
                                   .make = make_proxy};

}  // namespace palpable::haptics
