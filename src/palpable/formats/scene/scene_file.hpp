// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/models/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace palpable::formats {

/// A scene as it was read from a .palp file (docs/formats.md).
struct SceneFile {
  models::Scene scene;
  /// The version that it states, "1.0".
  std::string version;
  /// The file's own size.
  std::uintmax_t file_bytes = 0;
  /// Members that this version does not know; give them to write_scene() to keep them.
  ZipMembers others;
};

/// Whether a scene could be saved: at least one material and at most 256, every number finite, stiffness,
/// damping and friction not negative. Errors: invalid_input.
Result<void> check_scene(const models::Scene& scene);

/// Writes a scene atomically. The same scene gives the same bytes. Errors: check_scene()'s; failed, with the
/// system's reason.
Result<void> write_scene(const std::filesystem::path& path, const models::Scene& scene,
                         const ZipMembers& others = {});

/// Reads a scene. Errors: invalid_input, with the file's name, for what is missing, damaged, cut off, of a
/// newer major version, or states sizes beyond what is read (kMaxPixels, kMaxUnpackedBytes), always before
/// memory is taken for them.
Result<SceneFile> read_scene(const std::filesystem::path& path);

/// The same in memory; errors without a place.
Result<Bytes> encode_scene(const models::Scene& scene, const ZipMembers& others = {});
Result<SceneFile> decode_scene(std::span<const std::byte> file);

}  // namespace palpable::formats
