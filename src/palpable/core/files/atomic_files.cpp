// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/atomic_files.hpp"

#include <iterator>
#include <system_error>
#include <utility>

namespace palpable {

AtomicFiles::~AtomicFiles() {
  // Unfinished files are removed first: only empty folders can be removed.
  files_.clear();
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
    std::error_code not_empty;
    std::filesystem::remove(*folder, not_empty);
  }
}

Result<void> AtomicFiles::make_folder(const std::filesystem::path& folder) {
  std::error_code fault;
  if (std::filesystem::create_directory(folder, fault)) folders_.push_back(folder);
  if (fault) return Error{ErrorCode::failed, "cannot be made: " + fault.message(), folder.string()};
  return {};
}

Result<void> AtomicFiles::add(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  auto file = AtomicFile::create(path);
  if (!file) return std::move(file).error();
  if (auto written = file->write(bytes); !written) return written;
  files_.push_back(*std::move(file));
  return {};
}

Result<void> AtomicFiles::commit() {
  if (auto allowed = check_commits_allowed(); !allowed) return allowed;
  for (AtomicFile& file : files_)
    if (auto placed = file.put_in_place(); !placed) return placed;
  folders_.clear();
  for (const std::filesystem::path& path : outdated_) {
    std::error_code gone;
    std::filesystem::remove(path, gone);
  }
  return {};
}

}  // namespace palpable
