// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace palpable::cli {

/// An option that names a file to write, or a folder to write files into, as a command declares it.
struct OutputOption {
  enum class Kind : std::uint8_t { file, folder };
  /// All files that may be written for a value of the option.
  using FilesFor = std::function<std::vector<std::string>(const std::string& value)>;

  const CLI::App* command = nullptr;
  const CLI::Option* option = nullptr;
  /// The option's value once the command line is parsed; empty = nothing is written.
  const std::string* value = nullptr;
  /// The suffixes that select a format, each with its dot; empty = any name.
  std::vector<std::string> suffixes;
  /// Not given: the file that the value names.
  FilesFor files_for = nullptr;
  Kind kind = Kind::file;
};

/// What a command line names besides its outputs.
struct InputWords {
  /// The values of all options and arguments.
  std::vector<std::string> words;
  /// Those of the arguments, and other folders that the command reads: only they may name folders of inputs.
  std::vector<std::string> arguments;
};

/// Those of `command` as it was parsed; `outputs` may hold those of other commands too.
InputWords input_words(const CLI::App& command, std::span<const OutputOption> outputs);

/// Checks before any work that all outputs of a command can be written, and that none is an input. Inputs are
/// all files that the words name, by themselves or in an address (replay:FILE?…, 0:texture=FILE,…); every
/// file but a scene in a folder that an argument names (FOLDER, frames:FOLDER?…); and the sidecars of the
/// arguments. They are compared as files, so that links and other spellings make no difference. Nothing is
/// changed on the disk. Errors: usage for such a file, for "-", two outputs of one name, a wrong suffix, a
/// folder that is missing, is not a folder or is not writable; failed if the disk is full.
Result<void> check_outputs(std::span<const OutputOption> outputs, const InputWords& inputs);

/// The same for `command` as it was parsed; `outputs` may hold those of other commands too. `more`: folders
/// that every command may read.
Result<void> check_outputs(const CLI::App& command, std::span<const OutputOption> outputs,
                           const std::vector<std::filesystem::path>& more = {});

}  // namespace palpable::cli
