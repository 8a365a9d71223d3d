// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// A number given for a law: `option` is LawParameter::option.
struct LawNumber {
  std::string option;
  std::optional<double> value;
};

/// How the surface responds, as given on the command line. Without a law: the scene's own default.
struct LawArguments {
  std::string law;
  /// As typed: lengths in mm.
  std::vector<LawNumber> numbers;
};

/// Adds --law and an option for every parameter of every law. `arguments` must outlive the parsing, in its
/// place.
void add_law_options(Options& options, LawArguments& arguments);

/// What the library takes, the law by its name only (a scene that is not there yet may still refuse it);
/// without a name `otherwise`. Errors: usage, for an unknown name.
Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, haptics::Law otherwise);

/// What the library takes for this scene. Errors: usage, for a law that there is not for this kind of scene.
Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, const models::Scene& scene);

/// "proxy-friction", "rolling", …: the law as `bench` names it.
std::string bench_name(const haptics::LawParameters& parameters, const models::Scene& scene);

}  // namespace palpable::cli
