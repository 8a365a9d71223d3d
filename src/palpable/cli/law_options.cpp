// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/law_options.hpp"

#include "palpable/cli/suggest.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace palpable::cli {

void add_law_options(Options& options, LawArguments& arguments) {
  options.under("How the surface answers");
  options.text("--law", arguments.law, "Force law (palpable info SCENE lists those of a scene)");
  options.number("--stiffness", arguments.stiffness, {1e-9, 1e6},
                 "N/m; for rolling and sobel k_g in newtons");
  options.number("--damping", arguments.damping_Ns_per_m, {0.0, 1e4}, "N·s/m");
  options.number("--friction", arguments.friction, {0.0, 10.0},
                 "Coefficient of static friction; sliding takes 5/6 of it");
  options.number("--radius", arguments.radius_mm, {0.0, 20.0},
                 "Radius of the probing ball in mm; 0 = a point");
}

Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, haptics::Law otherwise) {
  haptics::LawParameters parameters;
  parameters.law = otherwise;
  if (!arguments.law.empty()) {
    const auto law = haptics::law_from(arguments.law);
    if (!law) return Error{ErrorCode::usage, fmt::format("there is no law {}", arguments.law), "--law"};
    parameters.law = *law;
  }
  parameters.stiffness_N_per_m = arguments.stiffness;
  parameters.damping_Ns_per_m = arguments.damping_Ns_per_m;
  parameters.static_friction = arguments.friction;
  parameters.radius_m = arguments.radius_mm / 1000.0;
  return parameters;
}

Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, const models::Scene& scene) {
  const auto laws = haptics::laws_for(scene);
  std::vector<std::string> names;
  for (const haptics::Law law : laws) names.emplace_back(haptics::name_of(law));
  if (!arguments.law.empty() && std::find(names.begin(), names.end(), arguments.law) == names.end()) {
    const auto meant = suggestion(arguments.law, names);
    return Error{ErrorCode::usage,
                 fmt::format("there is no law {} for a {}{}; there are {}", arguments.law,
                             models::kind_of(scene.model), meant ? ", did you mean " + *meant + "?" : "",
                             fmt::join(names, ", ")),
                 "--law"};
  }
  return law_parameters(arguments, laws.empty() ? haptics::Law::proxy : laws.front());
}

std::string bench_name(const haptics::LawParameters& parameters, const models::Scene& scene) {
  const double friction = parameters.static_friction.value_or(scene.materials.front().static_friction);
  const bool slides = parameters.law == haptics::Law::proxy && friction > 0.0;
  const bool textured = parameters.law == haptics::Law::proxy &&
                        std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& m) {
                          return m.texture.kind != models::TouchTexture::Kind::none;
                        });
  return std::string(haptics::name_of(parameters.law)) + (slides ? "-friction" : "") +
         (textured ? "-texture" : "");
}

}  // namespace palpable::cli
