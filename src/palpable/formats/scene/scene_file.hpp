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

/// A scene read from a .palp file (docs/formats.md).
struct SceneFile {
  models::Scene scene;
  /// The format version in the file, "1.0".
  std::string version;
  /// The file's own size.
  std::uintmax_t file_bytes = 0;
  /// Members unknown to this version; pass them to write_scene() to keep them.
  ZipMembers others;
};

/// Checks that a scene can be saved: 1 to 256 materials, all numbers finite, stiffness, damping and friction
/// not negative. Errors: invalid_input.
Result<void> check_scene(const models::Scene& scene);

/// Writes a scene atomically and deterministically. Errors: those of check_scene(); failed, with the system's
/// reason.
Result<void> write_scene(const std::filesystem::path& path, const models::Scene& scene,
                         const ZipMembers& others = {});

/// Reads a scene. Errors: invalid_input, with the file's name, for content that is missing, damaged,
/// truncated, of a newer major version, or larger than kMaxPixels or kMaxUnpackedBytes (checked before memory
/// is allocated).
Result<SceneFile> read_scene(const std::filesystem::path& path);

/// The same in memory; errors have no file name.
Result<Bytes> encode_scene(const models::Scene& scene, const ZipMembers& others = {});
Result<SceneFile> decode_scene(std::span<const std::byte> file);

}  // namespace palpable::formats
