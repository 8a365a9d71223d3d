// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}

namespace palpable::cli {

struct OutputOption;

/// A range with both ends included.
struct Range {
  double least = 0.0;
  double most = 0.0;
};

/// Declares the arguments and options of one command. It hides CLI11, whose header takes many seconds to
/// compile. The variables are set while the command line is parsed and must outlive that.
class Options {
 public:
  /// Every option that names a file to write is added to `outputs` (output_files.hpp).
  Options(CLI::App& app, std::vector<OutputOption>& outputs) : app_(app), outputs_(outputs) {}

  /// The heading in the help for the options that are declared after this.
  void under(const std::string& heading) { heading_ = heading; }

  /// A positional argument, required.
  void argument(const std::string& name, std::string& value, const std::string& help);
  /// Optional positional arguments; they come after the required ones.
  void optional_argument(const std::string& name, std::string& value, const std::string& help);
  void optional_arguments(const std::string& name, std::vector<std::string>& values, int most,
                          const std::string& help);
  void arguments(const std::string& name, std::vector<std::string>& values, int most,
                 const std::string& help);

  void flag(const std::string& name, bool& value, const std::string& help);
  void text(const std::string& name, std::string& value, const std::string& help);
  /// May be given several times, one value each.
  void texts(const std::string& name, std::vector<std::string>& values, const std::string& help);
  void required_text(const std::string& name, std::string& value, const std::string& help);
  /// A file to write, required or not; `suffixes` are those that its name may end in, none = any. It is
  /// checked before the command does its work.
  void required_output(const std::string& name, std::string& value, const std::vector<std::string>& suffixes,
                       const std::string& help);
  void output(const std::string& name, std::string& value, const std::vector<std::string>& suffixes,
              const std::string& help);
  /// The last declared output writes these files, for a value of its option.
  void last_output_writes(std::function<std::vector<std::string>(const std::string& value)> files_for);
  /// A folder to write files into. It is checked that none of its files is an input.
  void output_folder(const std::string& name, std::string& value, const std::string& help);
  /// For an option, declared as text, that names a file to write for some kinds of inputs only: returns the
  /// check of output(), for the command to call once it knows. The command must outlive it.
  std::function<Result<void>()> output_check(const std::string& name, const std::string& value,
                                             const std::vector<std::string>& suffixes) const;
  /// One of `words`; the help shows the default.
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
              const std::string& help);
  void number(const std::string& name, double& value, Range range, const std::string& help);
  void number(const std::string& name, std::optional<double>& value, Range range, const std::string& help);
  void integer(const std::string& name, int& value, Range range, const std::string& help);
  void integer(const std::string& name, std::optional<int>& value, Range range, const std::string& help);
  /// Without a sign, up to 2^63 - 1.
  void count(const std::string& name, std::uint64_t& value, const std::string& help);

  /// Returns a function that lists, after parsing, the names of the options on the command line: "--size".
  /// The command must outlive it.
  std::function<std::vector<std::string>()> given() const;
  /// Returns a function that gives, after parsing, the command line anew: the command, its arguments, then
  /// its options as --name=value; without files that it writes, and without what does not change the result
  /// (--json, --quiet, --threads). The command must outlive it.
  std::function<std::vector<std::string>()> repeated() const;
  /// Returns a function that lists, after parsing, the regular files that the command line names as inputs
  /// (check_outputs()), in the order of their names. The command must outlive it.
  std::function<std::vector<std::filesystem::path>()> input_files() const;

 private:
  CLI::App& app_;
  std::vector<OutputOption>& outputs_;
  std::string heading_ = "Options";
};

}  // namespace palpable::cli
