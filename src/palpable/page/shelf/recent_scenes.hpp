// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page::shelf {

/// What a shelf says of a scene.
struct SceneCard {
  std::string title;
  /// "a relief", "a street map", ….
  std::string kind;
  std::string sentence;
};

struct RecentScene {
  /// 32 hexadecimal digits.
  std::string id;
  SceneCard card;
  bool has_picture = false;
};

struct RecentLimits {
  std::size_t most_scenes = 12;
  /// Of all files together.
  std::uint64_t most_bytes = 512'000'000;
};

/// $XDG_STATE_HOME/palpable/scenes, or ~/.local/state/palpable/scenes; empty if neither is an absolute path.
std::filesystem::path user_state_folder();

/// The scenes that were opened lately: copies in a folder that only this user can enter, the oldest removed
/// beyond the limits. Several programs may use the folder. Any thread.
class RecentScenes {
 public:
  /// Uses `folder`, which is created; if that fails, or it is empty, `instead`, which exists.
  RecentScenes(const std::filesystem::path& folder, const std::filesystem::path& instead,
               RecentLimits limits = {});

  /// Whether `folder` is used, so that the scenes are there the next time.
  bool are_lasting() const { return are_lasting_; }
  /// The newest first. Files that do not belong together are left out.
  std::vector<RecentScene> list() const;
  /// Moves the scene's file into the folder and returns the scene's id. Errors: failed.
  Result<std::string> add(const std::filesystem::path& scene, const SceneCard& card,
                          const Raster<Rgb8>& picture);
  /// Replaces a scene's file, if the scene is still there. Errors: failed.
  Result<void> replace(std::string_view id, const std::filesystem::path& scene);
  /// The scene is the newest one now.
  void note_opened(std::string_view id);
  /// Its file; nullopt if there is no such scene. `id` is untrusted.
  std::optional<std::filesystem::path> scene(std::string_view id) const;
  std::optional<std::filesystem::path> picture(std::string_view id) const;
  void forget(std::string_view id);
  void forget_all();

 private:
  std::filesystem::path file(std::string_view id, const char* ending) const;
  void keep_limits();

  bool are_lasting_;
  std::filesystem::path folder_;
  RecentLimits limits_;
};

}  // namespace palpable::page::shelf
