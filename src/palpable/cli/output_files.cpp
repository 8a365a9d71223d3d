// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/output_files.hpp"

#include "palpable/cli/input_files.hpp"
#include "palpable/core/files/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

Error usage(std::string message, const fs::path& file) {
  return {ErrorCode::usage, std::move(message), file.string()};
}

Result<void> check_suffix(const OutputOption& output) {
  const fs::path file = *output.value;
  const auto& suffixes = output.suffixes;
  if (suffixes.empty() ||
      std::find(suffixes.begin(), suffixes.end(), file.extension().string()) != suffixes.end())
    return {};
  return usage(fmt::format("the name of the file to write ends in {}", fmt::join(suffixes, " or ")), file);
}

Result<void> check_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code none;
  if (!fs::exists(folder, none))
    return usage(fmt::format("cannot be written: there is no folder {}", folder.string()), file);
  if (!fs::is_directory(folder, none))
    return usage(fmt::format("cannot be written: {} is not a folder", folder.string()), file);
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return usage(fmt::format("cannot be written: the folder {} cannot be written to: {}", folder.string(),
                             std::generic_category().message(errno)),
                 file);
  return {};
}

Result<void> check_no_input(const fs::path& file, const InputFiles& inputs) {
  const auto named = inputs.find(file);
  if (!named) return {};
  return usage(
      named->empty()
          ? "is also an input of this command: give the file to write another name"
          : fmt::format("is one of the files in {}, which this command reads: give the file to write "
                        "another name or folder",
                        *named),
      file);
}

/// `file`: one of those that are written for `output`.
Result<void> check_file(const fs::path& file, const OutputOption& output, const InputFiles& inputs) {
  std::error_code none;
  if (fs::is_directory(file, none)) return usage("cannot be written: it is a folder", file);
  const auto status = fs::status(file, none);
  if (auto free = check_no_input(file, inputs); !free) return free;
  // A device or a pipe can always be written to, and its name has no suffix.
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  if (auto named = check_suffix(output); !named) return named;
  if (auto there = check_folder(file); !there) return there;
  return check_room(file);
}

/// The files in it may be replaced, so none of them may be an input, also through a link.
Result<void> check_output_folder(const fs::path& folder, const InputFiles& inputs) {
  std::error_code failed;
  if (!fs::exists(folder, failed)) return {};
  if (!fs::is_directory(folder, failed)) return usage("is a file, not a folder", folder);
  for (auto it = fs::directory_iterator(folder, failed); !failed && it != fs::directory_iterator();
       it.increment(failed))
    if (inputs.find(it->path()))
      return usage(fmt::format("holds an input of this command, {}: name another folder to write into",
                               it->path().filename().string()),
                   folder);
  return {};
}

std::vector<std::string> files_of(const OutputOption& output) {
  return output.files_for ? output.files_for(*output.value) : std::vector{*output.value};
}

/// The same name for all spellings of it, also where there is no file yet.
fs::path canonical_name(const fs::path& file) {
  std::error_code failed;
  const fs::path name = fs::weakly_canonical(file, failed);
  return failed ? file.lexically_normal() : name;
}

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return canonical_name(a) == canonical_name(b) || (fs::equivalent(a, b, none) && !none);
}

}  // namespace

Result<void> check_outputs(std::span<const OutputOption> outputs, const InputWords& words) {
  const InputFiles inputs(words);
  std::vector<fs::path> before;
  for (const OutputOption& output : outputs) {
    if (output.value->empty()) continue;
    if (*output.value == "-")
      return usage(
          "files are not written to standard output: give the file to write a name (./- for this one)",
          *output.value);
    if (output.kind == OutputOption::Kind::folder) {
      if (auto checked = check_output_folder(*output.value, inputs); !checked) return checked;
      continue;
    }
    for (const fs::path file : files_of(output)) {
      if (auto checked = check_file(file, output, inputs); !checked) return checked;
      if (std::any_of(before.begin(), before.end(),
                      [&](const fs::path& other) { return is_same(file, other); }))
        return usage("is named twice as a file to write", file);
      before.push_back(file);
    }
  }
  return {};
}

InputWords input_words(const CLI::App& command, std::span<const OutputOption> outputs) {
  InputWords inputs;
  for (const CLI::Option* option : command.get_options()) {
    const bool is_flag = option->get_expected_max() == 0;
    const bool is_output = std::any_of(outputs.begin(), outputs.end(), [option](const OutputOption& output) {
      return output.option == option;
    });
    if (is_flag || is_output) continue;
    auto& words = option->get_positional() ? inputs.arguments : inputs.words;
    words.insert(words.end(), option->results().begin(), option->results().end());
  }
  return inputs;
}

Result<void> check_outputs(const CLI::App& command, std::span<const OutputOption> all,
                           const std::vector<fs::path>& more) {
  std::vector<OutputOption> outputs;
  for (const OutputOption& output : all)
    if (output.command == &command) outputs.push_back(output);
  InputWords inputs = input_words(command, outputs);
  for (const fs::path& folder : more) inputs.arguments.push_back(folder.string());
  return check_outputs(outputs, inputs);
}

}  // namespace palpable::cli
