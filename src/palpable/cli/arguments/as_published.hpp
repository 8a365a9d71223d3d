// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/make_options.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace palpable::cli {

/// The settings of one of the five papers, as far as this program can reproduce them. No paper states a
/// stiffness or damping with a unit, so these stay the scene's. Settings of the user take precedence.
struct Published {
  std::string_view name;
  /// The law with its parameters; the probe is a point in all papers.
  haptics::LawParameters law;
  /// Rate of the servo; nullopt if the paper states none.
  std::optional<double> rate_hz;
  /// Differences from the paper, one sentence each.
  std::string_view differs;
  /// The kind of scene in the paper.
  session::MakeAs as = session::MakeAs::by_input;
  /// Sets how the scene is made.
  void (*make)(MakeArguments&) = nullptr;
};

/// Adds --as-published. `name` must outlive the parsing.
void add_as_published(Options& options, std::string& name);

/// The paper's settings; nullopt for an empty name. Errors: usage, for an unknown name.
Result<std::optional<Published>> published_as(const std::string& name);

/// What `make` makes for the paper, whatever the inputs are. (A touch also begins with scenes of that kind.)
session::MakeAs made_for(const Published& published);

/// For an error of usage because a given scene does not suit the paper: adds which command makes one that
/// does. Other errors are returned unchanged.
Error without_its_scene(Error error, const Published& published);

/// Sets the arguments for making the scene that `arguments` leave open.
void apply_published(const Published& published, MakeArguments& arguments);
/// Sets the paper's law parameters that `parameters`, which must be of that law, leave open.
void apply_published(const Published& published, haptics::LawParameters& parameters);

}  // namespace palpable::cli
