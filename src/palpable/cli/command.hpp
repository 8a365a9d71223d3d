// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"
#include "palpable/core/result.hpp"

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace palpable::cli {

using Json = nlohmann::ordered_json;

/// What a command has to say: `json` with --json, otherwise `text` (whole lines; may be empty).
struct Answer {
  Json json = Json::object();
  std::string text;
  /// Not done, though nothing failed on the way (doctor found a fault): the process's exit code.
  int exit_code = 0;
};

using Action = std::function<Result<Answer>(Console&)>;

/// The program's command line while it is being put together: one add_…() function a subcommand fills it.
struct Program {
  CLI::App app;
  CommonOptions common;
  /// What the parsed arguments ask for.
  Action action;
};

/// A new subcommand with the options that every command takes. `footer` shows examples, one a line.
CLI::App& add_command(Program& program, const std::string& name, const std::string& description,
                      const std::string& examples, Action action);

void add_doctor(Program& program);

}  // namespace palpable::cli
