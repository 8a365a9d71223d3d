// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace palpable {

/// Several files that a command writes together: none gets its name until all are on the disk. Without
/// commit() the destructor undoes everything; folders that were created are removed.
class AtomicFiles {
 public:
  AtomicFiles() = default;
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;
  ~AtomicFiles();

  /// Creates a folder for the next files if it does not exist. Errors: failed, with the system's reason.
  Result<void> make_folder(const std::filesystem::path& folder);
  /// Writes a file under a temporary name, or without one. Errors: as AtomicFile.
  Result<void> add(const std::filesystem::path& path, std::span<const std::byte> bytes);
  /// An older file that the new ones replace under another name: it is removed when all of them are there.
  void remove_after(const std::filesystem::path& path) { outdated_.push_back(path); }
  /// Renames all files to their names. At most once, as the last call. Errors: as AtomicFile::commit(); files
  /// before the failed one are then in place.
  Result<void> commit();

 private:
  std::vector<AtomicFile> files_;
  std::vector<std::filesystem::path> outdated_;
  /// Folders created by this object, in order.
  std::vector<std::filesystem::path> folders_;
};

}  // namespace palpable
