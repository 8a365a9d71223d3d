// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_arguments.hpp"
#include "palpable/models/scene/scene.hpp"

namespace palpable::cli {

/// Writes a distance field as the output's suffix says, one of export_formats.hpp's for a field: its surface
/// (.stl, .ply, .glb), a level set (.vdb) or distances on a lattice (.npz). Errors: interrupted; as the
/// encoders and write_file_atomically().
Result<Answer> export_field(const models::Field& field, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& work);
Result<Answer> export_field(const models::FieldOnLattice& field, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& work);

}  // namespace palpable::cli
