// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace palpable {

/// From now on no AtomicFile is committed once `*cancelled` is set, so that a result of work that was cut
/// short never replaces a file: commit() then returns the error `interrupted`. Null: always committed. For
/// the start of a program; `cancelled` must outlive all writes.
void refuse_commits_after(const std::atomic<bool>* cancelled) noexcept;
/// Error (interrupted) if commits are refused now.
Result<void> check_commits_allowed();

/// A file that is created completely or not at all. Bytes go into a new file in the same folder; commit()
/// flushes it to the disk and renames it over the old file, whose permissions are kept. Without commit() the
/// destructor removes the new file, and the old one is unchanged. On ext4, XFS, Btrfs and tmpfs the new file
/// has no name until commit(), so a killed program leaves nothing; elsewhere the next write of the same name
/// removes what was left. Not for the tick path.
class AtomicFile {
 public:
  /// Creates the new file. Errors: failed, with the system's reason (no such folder, permission denied, disk
  /// full ...).
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  Result<void> write(std::span<const std::byte> bytes);
  /// Flushes the file to the disk and renames it. At most once, as the last call. Errors: failed, with the
  /// system's reason; interrupted (refuse_commits_after()).
  Result<void> commit();

 private:
  friend class AtomicFiles;

  AtomicFile() = default;
  /// commit() without asking whether it is refused.
  Result<void> put_in_place();
  Error failure(std::string_view what) const;
  void discard() noexcept;
  bool name_beside();
  bool link_beside();

  std::filesystem::path path_;
  std::filesystem::path beside_;
  int descriptor_ = -1;
  bool is_stream_ = false;
};

/// Checks that a file can be created at `path` now: creates a new file in the same folder and removes it.
/// Errors: failed, with the system's reason.
Result<void> check_room(const std::filesystem::path& path);

/// Writes a whole file atomically, as AtomicFile does. A path that leads to a symbolic link replaces what the
/// link points to; one that leads to a device or pipe (/dev/stdout) is written to directly.
Result<void> write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace palpable
