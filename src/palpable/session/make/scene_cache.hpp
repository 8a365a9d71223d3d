// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/recipes/field_recipe.hpp"
#include "palpable/recipes/made_scene.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace palpable::session {

/// Where fields of meshes are stored, so that each is made once.
struct SceneCache {
  /// Created with the first entry, for its owner only; empty = no cache.
  std::filesystem::path folder;
  /// When an entry is stored, those not used for the longest time are removed until the folder's entries take
  /// no more than this. Larger scenes are not stored.
  std::uintmax_t most_bytes = std::uintmax_t{512} << 20U;
};

/// $XDG_CACHE_HOME/palpable/scenes, or ~/.cache/palpable/scenes; empty where neither is an absolute path.
std::filesystem::path user_cache_folder();

/// All that the field of a mesh depends on, as a text: the values of the mesh (hashed), the recipe, the
/// version `made_by` and the program file that runs, so that no entry outlives the code that made it.
std::string cache_key(const Mesh& mesh, const recipes::FieldRecipe& recipe, const std::string& made_by);

/// The stored scene with its notes. Nothing where there is none for this key, or where the entry is damaged:
/// it is then made again and replaced. Reads a file.
std::optional<recipes::MadeScene> read_cached(const SceneCache& cache, const std::string& key);

/// Stores a scene; several processes may do so at the same time. A cache that cannot be written changes
/// nothing: the next run makes the scene again. Writes a file.
void write_cached(const SceneCache& cache, const std::string& key, const recipes::MadeScene& made);

}  // namespace palpable::session
