// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/shelf_host.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page::shelf {

struct UploadLimits {
  /// Files that are kept at once; beyond them the oldest one that no scene is being made of is removed.
  std::size_t most_files = 16;
  std::uint64_t most_file_bytes = 300'000'000;
  /// Of all files together.
  std::uint64_t most_bytes = 1'000'000'000;
};

/// The name of a file as a browser gives it, percent-encoded, made safe: UTF-8 without folders and control
/// characters, not hidden, 1 to 120 bytes, with the ending that it had.
std::string safe_file_name(std::string_view encoded);

/// The files that home pages have sent, each in a folder of its own below `folder`. One thread.
class Uploads {
 public:
  /// `folder` exists, is for this user alone, and outlives this.
  Uploads(std::filesystem::path folder, UploadLimits limits);
  ~Uploads();
  Uploads(const Uploads&) = delete;
  Uploads& operator=(const Uploads&) = delete;

  /// Errors: failed, with a sentence for the person, if the file is too large or cannot be stored.
  Result<std::unique_ptr<Upload>> begin(std::string_view encoded_name, std::uint64_t bytes);
  /// The received file; nullopt for an unknown id.
  std::optional<std::filesystem::path> find(std::string_view id) const;
  void discard(std::string_view id);
  /// Keeps the files until release(): scenes are being made of them.
  void hold(const std::vector<std::string>& ids);
  /// Ends hold(); files that are `done` are removed, others may be tried again.
  void release(const std::vector<std::string>& ids, bool done);
  const UploadLimits& limits() const { return limits_; }

 private:
  struct Kept;
  class Receiving;

  bool make_room(std::uint64_t bytes);

  std::filesystem::path folder_;
  UploadLimits limits_;
  /// The oldest first. Shared with the uploads that are under way, which may outlive this.
  std::shared_ptr<std::vector<Kept>> kept_;
};

}  // namespace palpable::page::shelf
