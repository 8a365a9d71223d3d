// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/atomic_file.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace palpable {

/// Files that a command writes together: none has its name until all of them are on the disk. Destroyed
/// without commit(): nothing has changed, also folders that were made are removed.
class AtomicFiles {
 public:
  AtomicFiles() = default;
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();

  /// Makes a folder for the next files, where there is none. Errors: failed, with the system's reason.
  Result<void> make_folder(const std::filesystem::path& folder);
  /// Writes a file beside its place. Errors: as AtomicFile.
  Result<void> add(const std::filesystem::path& path, std::span<const std::byte> bytes);
  /// Renames all of them to their names. At most once, as the last call. Errors: as AtomicFile::commit(); the
  /// files before that one are then there.
  Result<void> commit();

 private:
  std::vector<AtomicFile> files_;
  /// Made by this, the first one first.
  std::vector<std::filesystem::path> folders_;
};

}  // namespace palpable
