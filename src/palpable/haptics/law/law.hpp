// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace palpable::haptics {

/// The force laws, ours and the papers' (docs/laws.md says what each does and where it fails).
enum class Law : std::uint8_t { proxy, tracing, groove, grid, rolling, penalty, averaged, sobel, tool };

/// What can be set of a law. A law reads only those of its own description; a value that is not given comes
/// from the scene's material or is the description's default.
struct LawParameters {
  Law law = Law::proxy;
  /// Of the contact spring.
  std::optional<double> stiffness_N_per_m;
  /// k_g of Shi & Pai: the force on a slope of 1.
  std::optional<double> slope_force_N;
  /// F_m of eq. 8: the force on a boundary of full strength.
  std::optional<double> tracing_force_N;
  /// Of the contact damper along the normal; of all motion in laws that act in the plane.
  std::optional<double> damping_Ns_per_m;
  /// A static coefficient alone sets the dynamic one to 5/6 of it.
  std::optional<double> static_friction;
  std::optional<double> dynamic_friction;
  /// Radius of the ball that touches; its centre is the hand's position. 0 = a point.
  std::optional<double> radius_m;
  /// Of `tool`: the radius of its round end, and how far below the hand the end's centre is.
  std::optional<double> tool_radius_m;
  std::optional<double> tool_length_m;
  /// 0: along the exact gradient of the potential; 1: along the surface's normal (force shading).
  std::optional<double> force_shading;
  /// Of `tracing`: 1, bounded by a speed gate and a tank of energy; 0, eq. 8 as it is printed.
  std::optional<double> tracing_bounds;
  /// The neighbourhood m of eq. 7.
  std::optional<double> neighbourhood_px;
  /// How far the four neighbours of `averaged` are from the centre, and the weights of the mean.
  std::optional<double> averaging_offset_m;
  std::optional<double> neighbour_weight;
  std::optional<double> centre_weight;
};

/// One parameter of one law: what user interfaces and files need to know of it.
struct LawParameter {
  /// Where its value is kept.
  std::optional<double> LawParameters::*value = nullptr;
  /// The member's name, in files and JSON.
  std::string_view name;
  /// For people: "Stiffness".
  std::string_view title;
  /// SI; empty for a ratio.
  std::string_view unit;
  /// The command line's option without its dashes (lengths in mm there); empty: none. Parameters of different
  /// laws may share one.
  std::string_view option;
  /// What is accepted, both ends included.
  double min = 0.0;
  double max = 0.0;
  /// What a slider offers.
  double slider_min = 0.0;
  double slider_max = 0.0;
  /// Where no value is given; none: the scene's material or the model decides.
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

/// Everything that is known of a law beforehand: all lists, help texts and user interfaces read this.
struct LawDescription {
  Law law = Law::proxy;
  /// On the command line and in files.
  std::string_view name;
  /// For people.
  std::string_view title;
  ModelKinds models;
  std::span<const LawParameter> parameters;
  /// The parameter that sets how strong the law is: a stiffness or a force.
  std::optional<double> LawParameters::*strength = nullptr;
  /// 2: acts in the plane and is felt on every device; 3: needs three axes; 6: needs torque too.
  int degrees_of_freedom = 3;
  /// The force is the gradient of a potential where damping, friction and force shading are 0.
  bool conservative = false;
  /// A spring against the surface with the scene's materials: stiffness limits apply.
  bool is_contact = false;
  bool renders_textures = false;
  /// Makes it (law_making.hpp).
  MadeLaw (*make)(const LawInput&) = nullptr;
};

/// The parameter that is kept in `value`; null where the law has none.
inline const LawParameter* find_parameter(const LawDescription& law,
                                          std::optional<double> LawParameters::*value) {
  for (const LawParameter& parameter : law.parameters)
    if (parameter.value == value) return &parameter;
  return nullptr;
}

}  // namespace palpable::haptics
