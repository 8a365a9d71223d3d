// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>

namespace palpable::formats {

/// The copy of a scene with changes that its user has not saved yet, so that no end of the program loses
/// them. One thread at a time.
class UnsavedScene {
 public:
  /// `save_as`: the file that the user would save; the copy is NAME-unsaved.palp beside it, or with a number
  /// if that exists.
  explicit UnsavedScene(std::filesystem::path save_as) : save_as_(std::move(save_as)) {}

  /// Writes the copy, in place of the one before. Errors: those of write_scene(), of which the first one is
  /// returned and the later ones are not.
  Result<void> keep(const models::Scene& scene);
  /// Removes the copy: the changes were saved or undone.
  void discard();
  /// A copy that an earlier touch left; empty if there is none.
  static std::filesystem::path of_earlier_touch(const std::filesystem::path& save_as);
  /// The copy; empty if there is none.
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path save_as_;
  std::filesystem::path file_;
  bool failed_ = false;
};

}  // namespace palpable::formats
