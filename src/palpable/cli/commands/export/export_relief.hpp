// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_arguments.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <string>

namespace palpable::cli {

/// Writes a relief as the output's suffix says: one of export_formats.hpp's for a relief that is no tactile
/// drawing. Errors: as
/// write_file_atomically() and the encoders.
Result<Answer> export_relief(const models::Relief& relief, const models::Scene& scene,
                             const ExportArguments& arguments);

/// Writes the solid between the surface and its base plate as .stl or .glb, the latter with the scene's
/// picture.
Result<void> write_body(const models::Relief& relief, const models::Scene& scene,
                        const std::filesystem::path& output);

/// The file beside a picture that says what its values mean.
std::string sidecar_of(const std::filesystem::path& output);
Result<void> write_sidecar(const Json& content, const std::filesystem::path& output);

}  // namespace palpable::cli
