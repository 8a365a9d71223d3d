// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/output_files.hpp"

#include <vector>

#include <CLI/CLI.hpp>

namespace palpable::cli {

/// The command line of the program: its commands, and what parsing it sets.
class Program {
 public:
  CLI::App app;
  CommonOptions common;
  /// The output options of all commands.
  std::vector<OutputOption> outputs;
  /// The action of the parsed command.
  Action action;
};

/// What the program does without a command: it opens the home page.
Action home_action();

/// Adds every command, with its options, to a new program.
void add_commands(Program& program);

}  // namespace palpable::cli
