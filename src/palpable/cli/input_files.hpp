// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace palpable::cli {

struct InputWords;

/// How an included sample is asked for: sample:map.
inline constexpr std::string_view kSamplePrefix = "sample:";

/// The folders in which samples are searched, if they exist.
std::vector<std::filesystem::path> sample_folders();

/// The existing files that a command line names as inputs (check_outputs() says which), compared by their
/// device and number, so that links and other spellings of a name make no difference.
class InputFiles {
 public:
  explicit InputFiles(const InputWords& words);

  /// Whether `file` exists and is one of them: the folder that it was found in, or an empty text if it is
  /// named itself. Devices such as a terminal are none.
  std::optional<std::string> find(const std::filesystem::path& file) const;
  /// The regular files among them, by the names that led to them, in the order of these names; with or
  /// without those that a folder holds.
  enum class Folders : std::uint8_t { included, left_out };
  std::vector<std::filesystem::path> regular_files(Folders folders) const;

 private:
  using Identity = std::pair<dev_t, ino_t>;
  static std::optional<Identity> identity_of(const std::filesystem::path& file);
  void add_word(const std::string& word);
  void add_argument(const std::string& argument);
  void add(const std::filesystem::path& file, const std::string& folder = {});

  struct Named {
    std::filesystem::path name;
    /// The folder that it was found in; empty for a file that is named itself.
    std::string folder;
  };
  std::map<Identity, Named> files_;
};

}  // namespace palpable::cli
