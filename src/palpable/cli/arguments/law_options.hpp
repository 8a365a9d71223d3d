// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/core/note.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// A number for a law; `option` is LawParameter::option.
struct LawNumber {
  std::string option;
  std::optional<double> value;
};

/// The law and its parameters on the command line. Without a law: the scene's default.
struct LawArguments {
  std::string law;
  /// As typed: lengths in mm.
  std::vector<LawNumber> numbers;
};

/// Adds --law and an option for every parameter of every law. `arguments` must outlive the parsing and must
/// not move.
void add_law_options(Options& options, LawArguments& arguments);

/// The law parameters for the library. Only the law's name is checked, since there may be no scene yet;
/// without a name, `otherwise` is used. Errors: usage, for an unknown name.
Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, haptics::Law otherwise);

/// The law parameters for this scene. Errors: usage, for a law that does not support this kind of scene.
Result<haptics::LawParameters> law_parameters(const LawArguments& arguments, const models::Scene& scene);

/// A note that names the given numbers that the law does not have; nullopt if it has all of them.
std::optional<Note> note_on_unused(const LawArguments& arguments, haptics::Law used);

/// The law with which this scene is touched: `chosen`, or the scene's default if it does not support that.
haptics::Law law_for(haptics::Law chosen, const models::Scene& scene);

/// "proxy-friction", "rolling", …: the law as `bench` names it.
std::string bench_name(const haptics::LawParameters& parameters, const models::Scene& scene);

}  // namespace palpable::cli
