// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/program.hpp"

#include "palpable/cli/help_format.hpp"

#include <fmt/format.h>

namespace palpable::cli {
namespace {

void add_common(Options& options, CommonOptions& common) {
  const std::string group = "Every command";
  options.under(group);
  options.flag("--json", common.json, "One JSON object on standard output");
  options.flag("--quiet", common.quiet, "No notes and no progress");
  options.integer("--threads", common.threads, {0.0, 256.0}, "Number of threads; 0 = one per processor");
  options.count("--seed", common.seed,
                "Seed of the random numbers: the same seed gives the same result, except in a touch with a "
                "device or a live source, which also follows the clock");
  options.integer("--progress-to", common.progress_to, {-1.0, 1023.0},
                  "Progress, notes and the error as lines of JSON on this open file descriptor; -1 = none");
  options.under("Options");
}

Options add_command_to(Program& program, CLI::App& parent, const std::string& name,
                       const std::string& description, const std::string& examples, Action action) {
  CLI::App& command = *parent.add_subcommand(name, description);
  command.group("Commands");
  command.footer("Examples:\n" + examples);
  command.callback([&program, action = std::move(action)] { program.action = action; });
  Options options(command, program.outputs);
  add_common(options, program.common);
  return options;
}

}  // namespace

Options add_command(Program& program, const std::string& name, const std::string& description,
                    const std::string& examples, Action action) {
  return add_command_to(program, program.app, name, description, examples, std::move(action));
}

Options add_command_below(Program& program, const std::string& parent, const std::string& name,
                          const std::string& description, const std::string& examples, Action action) {
  return add_command_to(program, *program.app.get_subcommand(parent), name, description, examples,
                        std::move(action));
}

void add_commands(Program& program) {
  CLI::App& app = program.app;
  app.name("palpable");
  // Commands inherit it.
  app.formatter(help_format());
  app.description(
      "Palpable makes pictures touchable. Without a command it opens its home page in the browser.");
  app.set_version_flag("--version", std::string("palpable ") + PALPABLE_VERSION);
  app.require_subcommand(0, 1);
  app.footer(
      "palpable help COMMAND explains a command, with examples.\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 unreadable or invalid input, 4 device, 130 "
      "interrupted.");
  Options options(app, program.outputs);
  add_common(options, program.common);
  add_home(program);
  add_touch(program);
  add_make(program);
  add_marker(program);
  add_correct(program);
  add_depth(program);
  add_compare(program);
  add_fit(program);
  add_fit_shapes(program);
  add_calibrate(program);
  add_rectify(program);
  add_listen(program);
  add_probe(program);
  add_sample(program);
  add_bench(program);
  add_show(program);
  add_info(program);
  add_export(program);
  program.app.add_subcommand("score", "Compare a result with the truth")
      ->group("Commands")
      ->require_subcommand(1);
  add_score(program);
  add_check(program);
  add_study_stability(program);
  add_study_tracing(program);
  add_study_trajectories(program);
  add_devices(program);
  add_share(program);
  add_methods(program);
  add_name(program);
  add_doctor(program);
  add_help(program);
}

}  // namespace palpable::cli
