// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace palpable::haptics {

/// The force laws: those of the papers and those of this project (docs/laws.md describes each and its
/// limits).
enum class Law : std::uint8_t { proxy, tracing, groove, grid, rolling, penalty, averaged, sobel, tool };

/// Parameters of all laws. A law uses only those in its own description. A value that is not set comes from
/// the scene's material, or is the default of the description.
struct LawParameters {
  Law law = Law::proxy;
  /// Stiffness of the contact spring.
  std::optional<double> stiffness_N_per_m;
  /// k_g of Shi & Pai: the force on a slope of 1.
  std::optional<double> slope_force_N;
  /// F_m of eq. 8: the force on a boundary of full strength.
  std::optional<double> tracing_force_N;
  /// Damping of the contact damper along the normal; in laws that act in the plane, of all motion.
  std::optional<double> damping_Ns_per_m;
  /// If only the static coefficient is set, the dynamic one is 5/6 of it.
  std::optional<double> static_friction;
  std::optional<double> dynamic_friction;
  /// Radius of the touching ball, whose centre is the hand's position. 0 = a point.
  std::optional<double> radius_m;
  /// For `tool`: the radius of its round end, and the distance of the end's centre below the hand.
  std::optional<double> tool_radius_m;
  std::optional<double> tool_length_m;
  /// 0: force along the exact gradient of the potential; 1: along the surface's normal (force shading).
  std::optional<double> force_shading;
  /// For `rolling`: over how much the relief is smoothed before the ball rolls on it.
  std::optional<double> rolling_smoothing_m;
  /// For `tracing`: 1 = bounded by a speed gate and an energy tank; 0 = eq. 8 as printed.
  std::optional<double> tracing_bounds;
  /// The neighbourhood m of eq. 7.
  std::optional<double> neighbourhood_px;
  /// For `averaged`: distance of the four neighbours from the centre, and the weights of the mean.
  std::optional<double> averaging_offset_m;
  std::optional<double> neighbour_weight;
  std::optional<double> centre_weight;
};

/// Description of one parameter of one law, for user interfaces and files.
struct LawParameter {
  /// The member that holds its value.
  std::optional<double> LawParameters::*value = nullptr;
  /// The member's name, in files and JSON.
  std::string_view name;
  /// Name for display: "Stiffness".
  std::string_view title;
  /// SI unit; empty for a ratio.
  std::string_view unit;
  /// The command line's option without its dashes (there lengths are in mm); empty: none. Parameters of
  /// different laws may share one.
  std::string_view option;
  /// The accepted range, both ends included.
  double min = 0.0;
  double max = 0.0;
  /// The range of a slider.
  double slider_min = 0.0;
  double slider_max = 0.0;
  /// The default; nullopt: the scene's material or the model determines the value.
  std::optional<double> preset;
};

/// The kinds of model that a law can render.
struct ModelKinds {
  bool relief = false;
  bool field = false;
  bool grid = false;
  bool contours = false;
};

struct LawInput;
struct MadeLaw;

/// Static description of a law. All lists, help texts and user interfaces are made from it.
struct LawDescription {
  Law law = Law::proxy;
  /// Name on the command line and in files.
  std::string_view name;
  /// Name for display.
  std::string_view title;
  /// Where the law was published first.
  std::string_view paper;
  ModelKinds models;
  std::span<const LawParameter> parameters;
  /// The parameter that scales the law's force: a stiffness or a force.
  std::optional<double> LawParameters::*strength = nullptr;
  /// 2: acts in the plane, for every device; 3: needs three axes; 6: also needs torque.
  int degrees_of_freedom = 3;
  /// Whether the force is the gradient of a potential if damping, friction and force shading are 0.
  bool conservative = false;
  /// Whether it is a spring against the surface with the scene's materials, to which stiffness limits apply.
  bool is_contact = false;
  bool renders_textures = false;
  /// Which of two rules of contact the law breaks, as a clause with its figure: no force in free air, and a
  /// first contact in the tick in which it happens. Empty if it keeps both. Such a law is no kind's default.
  std::string_view contact_error = {};
  /// Creates the law (law_making.hpp).
  MadeLaw (*make)(const LawInput&) = nullptr;
};

/// The parameter with this member; null if the law does not have it.
inline const LawParameter* find_parameter(const LawDescription& law,
                                          std::optional<double> LawParameters::*value) {
  for (const LawParameter& parameter : law.parameters)
    if (parameter.value == value) return &parameter;
  return nullptr;
}

}  // namespace palpable::haptics
