// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_arguments.hpp"
#include "palpable/models/contours/contours.hpp"
#include "palpable/models/scene/scene.hpp"

namespace palpable::cli {

/// Writes contours as the output's suffix says, one of export_formats.hpp's for contours: as a plate with
/// grooves or raised lines, as outlines for swell paper or an embosser, or as a picture of the lines. As
/// .npz: unit tangents in image axes (x right, y down; the sign is arbitrary) and strength of the averaged
/// map (eq. 7), and the one-pixel-wide lines.
Result<Answer> export_contours(const models::Contours& contours, const models::Scene& scene,
                               const ExportArguments& arguments);

}  // namespace palpable::cli
