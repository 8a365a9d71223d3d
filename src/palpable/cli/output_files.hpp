// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <span>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace palpable::cli {

/// An option that names a file to write, as a command declares it.
struct OutputOption {
  const CLI::App* command = nullptr;
  const CLI::Option* option = nullptr;
  /// The option's value once the command line is parsed; empty = nothing is written.
  const std::string* value = nullptr;
  /// The suffixes that select a format, each with its dot; empty = any name.
  std::vector<std::string> suffixes;
  /// What the names of the files add to the value; one empty word where the value is the name itself.
  std::vector<std::string> endings{std::string()};
};

/// Whether everything that the command is to write can be written, asked before any work is done. `words` are
/// the other values on its command line: no output may be a file that one of them names, also through links.
/// Nothing is changed on the disk. Errors: usage for such a file, for two outputs of one name, a wrong
/// suffix, a folder that is missing, is none or may not be written to; failed where there is no room.
Result<void> check_outputs(std::span<const OutputOption> outputs, std::span<const std::string> words);

}  // namespace palpable::cli
