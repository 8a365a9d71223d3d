// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/groove.hpp"

#include "palpable/haptics/law/law_parameters.hpp"
#include "palpable/haptics/law/proxy.hpp"

#include <array>

namespace palpable::haptics {
namespace {

constexpr std::array kParameters{kStiffness, kContactDamping, kStaticFriction, kDynamicFriction, kRadius};

}  // namespace

constexpr LawDescription kGrooveLaw{.law = Law::groove,
                                    .name = "groove",
                                    .title = "Grooves",
                                    .paper = "Zilles & Salisbury 1995; Ruspini, Kolarov & Khatib 1997",
                                    .models = {.contours = true},
                                    .parameters = kParameters,
                                    .strength = &LawParameters::stiffness_N_per_m,
                                    .conservative = true,
                                    .is_contact = true,
                                    .renders_textures = true,
                                    .make = make_proxy};

}  // namespace palpable::haptics
