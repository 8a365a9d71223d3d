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
  /// Suffixes of the file names that are appended to the value; one empty string if the value is the name
  /// itself.
  std::vector<std::string> endings{std::string()};
};

/// Checks before any work that all outputs of a command can be written. `words` are the other values on its
/// command line: no output may be a file that one of them names, also through links. Nothing is changed on
/// the disk. Errors: usage for such a file, for "-", two outputs of one name, a wrong suffix, a folder that
/// is missing, is not a folder or is not writable; failed if the disk is full.
Result<void> check_outputs(std::span<const OutputOption> outputs, std::span<const std::string> words);

}  // namespace palpable::cli
