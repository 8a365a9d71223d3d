// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <string>

namespace palpable::cli {

/// A scene's title and its maker's description, as given on the command line; empty where not given.
struct TitleArguments {
  std::string title;
  /// The text itself, or @ and the name of a UTF-8 text file.
  std::string description;
};

/// Adds --title and --describe. `arguments` must outlive the parsing.
void add_title_options(Options& options, TitleArguments& arguments);

/// Reads the description's file and removes surrounding white space. Errors: usage for a title of several
/// lines, or for text that is too long or not UTF-8; errors of reading the file.
Result<TitleArguments> read_title(TitleArguments arguments);

/// Sets the title and description that are not empty. `title` comes from read_title().
void apply_title(const TitleArguments& title, models::Scene& scene);

}  // namespace palpable::cli
