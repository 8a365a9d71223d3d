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

/// What kind of input a file is.
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
  /// that holds both. depth: one, or its colour picture first and the depth second. video: one film, or the
  /// pictures of a folder in the order of their names (numbers counted as numbers). map: one.
  std::vector<std::filesystem::path> files;
  /// Notes for the person.
  std::vector<Note> notes;
};

/// What one file is, by its first bytes and never by its name: pictures of every kind that read_picture()
/// knows are `picture` (a stereo file of a camera, MPO or JPS, is `stereo`); PFM, NumPy and OpenEXR hold
/// numbers and are `depth`; MP4, Matroska, AVI, MPEG and Ogg are `video`; OpenStreetMap extracts are `map`;
/// GLB, OBJ, STL, CityJSON and PLY with faces are `mesh`; PLY without faces is `points`; JSON with
/// "primitives" is `shapes`; OpenVDB is `level_set`; ours is `scene`.
/// Errors: invalid_input, naming the file, for what cannot be read or is none of these.
Result<InputKind> kind_of_file(const std::filesystem::path& path);

/// Recognises what was named together: one file by its content, a photograph with depth inside as depth, a
/// picture of one channel as depth where a sidecar states so or where it has more than 8 bits (unless these
/// are 8 bits stretched), with a note of what was assumed, two
/// pictures as a stereo pair, left first, a picture and a file of numbers as depth with its colour picture, a
/// folder as a sequence. `wanted` overrides where it is possible. Errors: usage for a number of files that
/// makes no sense; invalid_input as kind_of_file(), and for a folder without pictures.
Result<Input> recognise_input(std::span<const std::filesystem::path> paths,
                              std::optional<InputKind> wanted = std::nullopt);

}  // namespace palpable::sources
