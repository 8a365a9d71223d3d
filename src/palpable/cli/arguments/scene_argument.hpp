// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/formats/scene/scene_file.hpp"

#include <filesystem>

namespace palpable::cli {

/// Reads the scene file in a command's argument SCENE. Errors: as formats::read_scene(). For an input of
/// another kind (a picture, a mesh, …) the message says what it is and which command makes a scene of it; for
/// a pipe or a folder, that it is not a scene.
Result<formats::SceneFile> read_scene_argument(const std::filesystem::path& path);

/// The error of a file that cannot be read as a mesh: `reason`, or what the file is instead.
Error not_a_mesh(const std::filesystem::path& path, Error reason);

/// Errors: usage, naming the path, unless its name ends in .palp.
Result<void> check_scene_name(const std::filesystem::path& path);

}  // namespace palpable::cli
