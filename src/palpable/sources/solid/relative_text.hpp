// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace palpable::sources {

/// The text of a mesh, with its coordinates relative to `origin`.
struct RelativeText {
  std::string text;
  Vec3 origin;
};

/// Moves a mesh in text whose box is far from the origin, in comparison with its size, to the origin: Assimp
/// keeps coordinates in single precision, which there would lose its shape. `keyword` begins a line with a
/// vertex: "v" (OBJ) or "vertex" (STL). nullopt: the mesh is near its origin, or a vertex is not three
/// numbers, or three and a colour; then the text should be read as it is.
std::optional<RelativeText> relative_to_its_place(std::string_view text, std::string_view keyword);

}  // namespace palpable::sources
