// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/make_options.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace palpable::cli {

/// What one of the five papers set together, as far as this program holds it. None of them states a
/// stiffness or a damping in a unit: those stay the scene's. What the person sets goes before it.
struct Published {
  std::string_view name;
  /// With its parameters; the probe is a point in all of them.
  haptics::LawParameters law;
  /// Of the servo; not given where the paper states none.
  std::optional<double> rate_hz;
  /// What of the paper is not the same here, a sentence each.
  std::string_view differs;
  /// What the scene became.
  session::MakeAs as = session::MakeAs::by_input;
  /// How the scene is made.
  void (*make)(MakeArguments&) = nullptr;
};

/// Adds --as-published. `name` must outlive the parsing.
void add_as_published(Options& options, std::string& name);

/// The paper's settings; nothing for an empty name. Errors: usage, for another name.
Result<std::optional<Published>> published_as(const std::string& name);

/// Sets how the scene is made where `arguments` leave it open.
void apply_published(const Published& published, MakeArguments& arguments);
/// The paper's parameters of its law where `parameters`, which are of that law, leave them open.
void apply_published(const Published& published, haptics::LawParameters& parameters);

}  // namespace palpable::cli
