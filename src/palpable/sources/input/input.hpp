// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::sources {

/// The kind of an input file.
enum class InputKind : std::uint8_t {
  picture,
  stereo,
  depth,
  video,
  map,
  mesh,
  points,
  shapes,
  level_set,
  scene
};

/// "picture", "stereo", …; and back, nullopt for an unknown name.
std::string_view name_of(InputKind kind);
std::optional<InputKind> input_kind_from(std::string_view name);

/// The recognised input of a command.
struct Input {
  InputKind kind = InputKind::picture;
  /// As given. picture, scene, mesh, points, shapes, level_set: one. stereo: two, left first, or one file
  /// that holds both. depth: one, or its colour picture first and the depth second. video: one video, or the
  /// pictures of a folder in the order of their names (numbers counted as numbers). map: one.
  std::vector<std::filesystem::path> files;
  /// Notes for the user.
  std::vector<Note> notes;
};

/// Recognises one file by its first bytes, never by its name. Pictures that read_picture() supports are
/// `picture` (a camera's stereo file, MPO or JPS, is `stereo`); PFM, NumPy and OpenEXR contain numbers and
/// are `depth`. MP4, Matroska, AVI, MPEG and Ogg are `video`; OpenStreetMap extracts are `map`; GLB, OBJ,
/// STL, CityJSON and PLY with faces are `mesh`; PLY without faces is `points`; JSON with "primitives" is
/// `shapes`; OpenVDB is `level_set`; this program's scene files are `scene`.
/// Errors: invalid_input, naming the file, for unreadable and unknown files.
Result<InputKind> kind_of_file(const std::filesystem::path& path);

/// Recognises files that were given together. One file: by its content; a photograph with depth inside is
/// depth; a picture of one channel is depth if a sidecar states so or it has more than 8 bits (unless these
/// are 8 bits stretched), with a note about the assumption. Two pictures: a stereo pair, left first. A
/// picture and a file of numbers: depth with its colour picture. A folder: a sequence. `wanted` overrides
/// this where possible. Errors: usage for an impossible number of files; invalid_input as kind_of_file(), and
/// for a folder without pictures.
Result<Input> recognise_input(std::span<const std::filesystem::path> paths,
                              std::optional<InputKind> wanted = std::nullopt);

}  // namespace palpable::sources
