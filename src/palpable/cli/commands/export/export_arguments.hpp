// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/commands/export/export_tactile.hpp"

#include <functional>
#include <string>
#include <vector>

namespace palpable::cli {

/// Arguments and options of `export`. Which options a format reads, export_formats.hpp says.
struct ExportArguments {
  std::string scene, output;
  TactileArguments tactile;
  std::string lines = "grooves";
  int grid = 128;
  std::string band = "narrow";
  /// The names of the options on the command line.
  std::function<std::vector<std::string>()> given;
};

}  // namespace palpable::cli
