// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/output_files.hpp"

#include "palpable/core/files/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

Error usage(std::string message, const fs::path& file) {
  return {ErrorCode::usage, std::move(message), file.string()};
}

/// Whether both exist and are the same file.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return fs::equivalent(a, b, none) && !none;
}

/// The parts of a word that may name a file: the word itself, and the parts after @ : = (`@FILE`,
/// `replay:FILE`, `0:texture=FILE,pitch=2`).
std::vector<std::string> names_in(const std::string& word) {
  std::vector<std::string> names{word};
  for (std::size_t at = word.find_first_of("@:="); at != std::string::npos;
       at = word.find_first_of("@:=", at + 1))
    names.push_back(word.substr(at + 1, word.find(',', at) - at - 1));
  return names;
}

bool names_file(const std::string& word, const fs::path& file) {
  const auto names = names_in(word);
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return !name.empty() && same_file(name, file); });
}

Result<void> check_suffix(const fs::path& file, const std::vector<std::string>& suffixes) {
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

Result<void> check_output(const fs::path& file, const OutputOption& option,
                          std::span<const std::string> words) {
  std::error_code none;
  if (*option.value == "-")
    return usage("files are not written to standard output: give the file to write a name (./- for this one)",
                 file);
  if (fs::is_directory(file, none)) return usage("cannot be written: it is a folder", file);
  // A device or a pipe can always be written to, and its name has no suffix.
  const auto status = fs::status(file, none);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  if (auto named = check_suffix(file, option.suffixes); !named) return named;
  if (auto there = check_folder(file); !there) return there;
  for (const std::string& word : words)
    if (names_file(word, file))
      return usage("is also an input of this command: give the file to write another name", file);
  return check_room(file);
}

}  // namespace

Result<void> check_outputs(std::span<const OutputOption> outputs, std::span<const std::string> words) {
  std::vector<fs::path> before;
  for (const OutputOption& option : outputs) {
    if (option.value->empty()) continue;
    for (const std::string& ending : option.endings) {
      const fs::path file = *option.value + ending;
      if (auto checked = check_output(file, option, words); !checked) return checked;
      const bool twice = std::any_of(before.begin(), before.end(), [&](const fs::path& other) {
        return file.lexically_normal() == other.lexically_normal() || same_file(file, other);
      });
      if (twice) return usage("is named twice as a file to write", file);
      before.push_back(file);
    }
  }
  return {};
}

}  // namespace palpable::cli
