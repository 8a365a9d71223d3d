// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/note.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace palpable::session {

/// The cache of mesh fields, so that each is computed once.
struct SceneCache {
  /// Created with the first entry, with access for its owner only; empty = no cache.
  std::filesystem::path folder;
  /// Greatest total size. When an entry is stored, the least recently used ones are removed until the total
  /// is within this limit. Larger scenes are not stored. 0: entries are not read either.
  std::uintmax_t most_bytes = std::uintmax_t{512} << 20U;
};

/// $XDG_CACHE_HOME/palpable/scenes, or ~/.cache/palpable/scenes; empty if neither is an absolute path.
std::filesystem::path user_cache_folder();

/// A limit of the cache's size.
struct CacheLimit {
  std::uintmax_t bytes = SceneCache{}.most_bytes;
  /// Says that the stated limit is none and which one is used.
  std::optional<Note> note;
};

/// The limit that $PALPABLE_CACHE_MB states, a whole number of megabytes (10^6 bytes; 0: nothing is stored or
/// read); that of SceneCache if it is not set or empty, and, with a note, if it is no such number.
CacheLimit user_cache_limit();

/// Everything that the field of a mesh depends on, as text: the hash of the mesh, the recipe, the version
/// `made_by`, and the identifier of the running program, so that an entry is not used by another build.
std::string cache_key(const Mesh& mesh, const recipes::FieldRecipe& recipe, const std::string& made_by);

/// The stored scene with its notes; nullopt if there is none for this key or the entry is damaged: it is then
/// computed again and replaced. Reads a file.
std::optional<recipes::MadeScene> read_cached(const SceneCache& cache, const std::string& key);

/// Stores a scene; several processes may do so at the same time. Failures are ignored: the next run computes
/// the scene again. Writes a file.
void write_cached(const SceneCache& cache, const std::string& key, const recipes::MadeScene& made);

}  // namespace palpable::session
