// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"
#include "palpable/cli/options.hpp"
#include "palpable/core/result.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace palpable::cli {

using Json = nlohmann::ordered_json;

/// The result of a command: `json` with --json, otherwise `text` (whole lines; may be empty).
struct Answer {
  Json json = Json::object();
  std::string text;
  /// The exit code of a command that ran without an error, but whose result is negative (doctor found a
  /// fault).
  int exit_code = 0;
};

using Action = std::function<Result<Answer>(Console&)>;

/// The program's command line; each add_…() function below adds a subcommand.
class Program;

/// Adds a subcommand with the common options; `examples` are shown below its help, one per line.
Options add_command(Program& program, const std::string& name, const std::string& description,
                    const std::string& examples, Action action);
/// The same below a command of commands: `parent` is "score", `name` "disparity".
Options add_command_below(Program& program, const std::string& parent, const std::string& name,
                          const std::string& description, const std::string& examples, Action action);

/// Runs a command line of this program within another command: "make", its arguments, …. How it reports is as
/// in `from`; the seed is its own. It may write no file but its --output, and name no file but `inputs`.
/// Errors: usage for words that are no command line of this version or that name other files; those of the
/// command.
Result<Answer> run_command(const std::vector<std::string>& words,
                           std::span<const std::filesystem::path> inputs, const CommonOptions& from);

/// The help of a command ("score", "disparity"), or of the program. Errors: usage for an unknown command.
Result<std::string> help_text(const Program& program, const std::vector<std::string>& words);

void add_bench(Program& program);
void add_calibrate(Program& program);
void add_check(Program& program);
void add_compare(Program& program);
void add_correct(Program& program);
void add_depth(Program& program);
void add_devices(Program& program);
void add_doctor(Program& program);
void add_export(Program& program);
void add_fit(Program& program);
void add_fit_shapes(Program& program);
void add_help(Program& program);
void add_home(Program& program);
void add_info(Program& program);
void add_listen(Program& program);
void add_make(Program& program);
void add_marker(Program& program);
void add_methods(Program& program);
void add_name(Program& program);
void add_probe(Program& program);
void add_rectify(Program& program);
void add_sample(Program& program);
void add_score(Program& program);
/// score boundary and score orientation.
void add_score_contours(Program& program);
void add_score_map(Program& program);
void add_score_structure(Program& program);
void add_show(Program& program);
void add_share(Program& program);
void add_study_stability(Program& program);
void add_study_tracing(Program& program);
void add_study_trajectories(Program& program);
void add_touch(Program& program);

}  // namespace palpable::cli
