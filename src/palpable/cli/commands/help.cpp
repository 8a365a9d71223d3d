// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"

namespace palpable::cli {

void add_help(Program& program) {
  const auto words = std::make_shared<std::vector<std::string>>();
  Options options = add_command(program, "help", "Explain a command with its options and examples",
                                "  palpable help\n"
                                "  palpable help make\n"
                                "  palpable help score disparity",
                                [&program, words](Console& /*console*/) -> Result<Answer> {
                                  auto text = help_text(program, *words);
                                  if (!text) return std::move(text).error();
                                  return Answer{{{"help", *text}}, *text};
                                });
  constexpr int kMostWords = 2;
  options.optional_arguments("COMMAND", *words, kMostWords,
                             "The command to explain; default: the list of commands");
}

}  // namespace palpable::cli
