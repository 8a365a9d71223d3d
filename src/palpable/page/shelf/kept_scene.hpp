// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/shelf/recent_scenes.hpp"

#include <filesystem>
#include <mutex>
#include <string>

namespace palpable::page::shelf {

constexpr int kCardPictureSide = 480;

/// The copy of the scene that is touched, among those opened lately. Any thread.
class KeptScene {
 public:
  /// `id`: of the copy; empty: there is none yet. `temporary`: a file of this alone, on the way to the copy.
  /// `others`: members of the scene's file that are kept as they are. `recent` outlives this.
  KeptScene(RecentScenes& recent, std::string id, std::filesystem::path temporary,
            formats::ZipMembers others);

  /// Writes the scene, as a person has changed it, in place of the copy; a scene without a copy (a sample)
  /// gets one. Errors: those of write_scene(); failed, if the copy was removed from the list.
  Result<void> keep(const models::Scene& scene);
  /// Puts a finer version of the scene, from this file, in place of the copy; false if there is none.
  bool replace(const std::filesystem::path& finer);

 private:
  RecentScenes& recent_;
  std::filesystem::path temporary_;
  formats::ZipMembers others_;
  std::mutex mutex_;
  std::string id_;
};

}  // namespace palpable::page::shelf
