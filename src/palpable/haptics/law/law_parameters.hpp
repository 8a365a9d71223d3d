// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"

namespace palpable::haptics {

// Descriptions of parameters that several laws share.

/// The unit of a parameter that is 0 for no and 1 for yes: the page shows it as a switch.
inline constexpr std::string_view kYesOrNo = "yes or no";

inline constexpr LawParameter kStiffness{&LawParameters::stiffness_N_per_m,
                                         "stiffness_N_per_m",
                                         "Stiffness",
                                         "N/m",
                                         "stiffness",
                                         1e-6,
                                         1e6,
                                         20.0,
                                         2000.0,
                                         std::nullopt};
inline constexpr LawParameter kContactDamping{&LawParameters::damping_Ns_per_m,
                                              "damping_Ns_per_m",
                                              "Damping",
                                              "N·s/m",
                                              "damping",
                                              0.0,
                                              1e4,
                                              0.0,
                                              20.0,
                                              std::nullopt};
inline constexpr LawParameter kStaticFriction{&LawParameters::static_friction,
                                              "static_friction",
                                              "Friction",
                                              "",
                                              "friction",
                                              0.0,
                                              10.0,
                                              0.0,
                                              2.0,
                                              std::nullopt};
inline constexpr LawParameter kDynamicFriction{&LawParameters::dynamic_friction,
                                               "dynamic_friction",
                                               "Sliding friction",
                                               "",
                                               "sliding-friction",
                                               0.0,
                                               10.0,
                                               0.0,
                                               2.0,
                                               std::nullopt};
inline constexpr LawParameter kRadius{
    &LawParameters::radius_m, "radius_m", "Radius of the probe", "m", "radius", 0.0, 0.02, 0.0, 0.005, 0.0};
inline constexpr LawParameter kForceShading{&LawParameters::force_shading,
                                            "force_shading",
                                            "Force shading",
                                            "",
                                            "force-shading",
                                            0.0,
                                            1.0,
                                            0.0,
                                            1.0,
                                            0.0};
/// For Shi & Pai's laws: the force on a slope of 1.
inline constexpr LawParameter kSlopeForce{&LawParameters::slope_force_N,
                                          "slope_force_N",
                                          "Force on a slope of 1",
                                          "N",
                                          "stiffness",
                                          1e-6,
                                          1e6,
                                          0.1,
                                          5.0,
                                          1.0};
inline constexpr LawParameter kPlaneDamping{&LawParameters::damping_Ns_per_m,
                                            "damping_Ns_per_m",
                                            "Damping of all motion",
                                            "N·s/m",
                                            "damping",
                                            0.0,
                                            1e4,
                                            0.0,
                                            20.0,
                                            0.5};

/// The value that is set, else the parameter's default (0 if it has none).
inline double value_or_preset(const LawParameters& parameters, const LawParameter& parameter) {
  return (parameters.*parameter.value).value_or(parameter.preset.value_or(0.0));
}

}  // namespace palpable::haptics
