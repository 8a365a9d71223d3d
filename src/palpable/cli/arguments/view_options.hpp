// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/session/touch/walk.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// The frame of reference, as given on the command line.
struct ViewArguments {
  std::string view = "exocentric";
  std::string walk;
};

/// Adds --view and --walk. `arguments` must outlive the parsing.
void add_view_options(Options& options, ViewArguments& arguments);

/// The explorer's walk; empty for the exocentric view. Egocentric without a walk: at the centre, facing up.
/// The file is a CSV t_s,x_m,y_m,heading_deg. Errors: usage for a walk without --view egocentric;
/// invalid_input, naming the file.
Result<std::vector<session::WalkStep>> walk_from(const ViewArguments& arguments);

}  // namespace palpable::cli
