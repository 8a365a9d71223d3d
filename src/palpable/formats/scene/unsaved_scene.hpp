// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <cstdint>
#include <filesystem>

namespace palpable::formats {

/// Saves the scene that a user changes, and until then a copy of it, so that no end of the program loses the
/// changes. One thread at a time.
class UnsavedScene {
 public:
  /// `save_as`: the file that the user would save; the copy is NAME-unsaved.palp beside it, or with a number
  /// if that exists.
  explicit UnsavedScene(std::filesystem::path save_as);

  /// Writes the copy, in place of the one before. Errors: those of write_scene(), of which the first one is
  /// returned and the later ones are not.
  Result<void> keep(const models::Scene& scene);
  /// Writes the file and discards the copy. Errors: those of write_scene(); failed, once, if the file is not
  /// the one that was there at construction or that was saved last: saving again replaces it; failed, if a
  /// pipe or a device has its name.
  Result<void> save(const models::Scene& scene);
  /// Removes the copy: the changes were saved or undone.
  void discard();
  /// A copy that an earlier touch left; empty if there is none.
  static std::filesystem::path of_earlier_touch(const std::filesystem::path& save_as);
  /// The copy; empty if there is none.
  const std::filesystem::path& file() const { return file_; }
  const std::filesystem::path& save_as() const { return save_as_; }

 private:
  /// Tells a file from one that took its place; all zero if there is none.
  struct FileState {
    std::uint64_t device = 0, inode = 0;
    std::int64_t bytes = 0, changed_ns = 0;
    bool operator==(const FileState&) const = default;
  };
  static FileState state_of(const std::filesystem::path& file);

  std::filesystem::path save_as_;
  std::filesystem::path file_;
  FileState known_;
  bool failed_ = false;
};

}  // namespace palpable::formats
