// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <optional>
#include <string>

namespace palpable::cli {

/// How the surface answers, as given on the command line. Without a law: the scene's own default.
struct LawArguments {
  std::string law;
  std::optional<double> stiffness;
  std::optional<double> damping_Ns_per_m;
  std::optional<double> friction;
  double radius_mm = 0.0;
};

/// Adds --law, --stiffness, --damping, --friction and --radius. `arguments` must outlive the parsing.
void add_law_options(Options& options, LawArguments& arguments);

/// What the library takes, the law by its name only (a scene that is not there yet may still refuse it);
/// without a name `otherwise`. Errors: usage, for an unknown name.
Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, haptics::Law otherwise);

/// What the library takes for this scene. Errors: usage, for a law that there is not for this kind of scene.
Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, const models::Scene& scene);

/// "proxy-friction", "rolling", …: the law as `bench` names it.
std::string bench_name(const haptics::LawParameters& parameters, const models::Scene& scene);

}  // namespace palpable::cli
