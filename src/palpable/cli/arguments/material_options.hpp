// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace palpable::cli {

/// A scene's materials, as given on the command line.
struct MaterialArguments {
  /// "LABEL:key=value,…" each; see apply_materials().
  std::vector<std::string> materials;
  /// An 8-bit grey picture of the scene's shape whose values are labels.
  std::string labels;
  /// The pictures that they name, by file: read once, since a pipe can be read only once.
  std::map<std::string, std::shared_ptr<const Image>> pictures;
};

/// Adds --material and --labels. `arguments` must outlive the parsing.
void add_material_options(Options& options, MaterialArguments& arguments);

/// Reads the pictures before a scene is made, and checks that apply_materials() can parse the texts. Errors:
/// as there, except those that depend on the scene.
Result<void> read_materials(MaterialArguments& arguments);

/// Sets the materials and the label picture of `scene`. Each text is LABEL (0 … 255), a colon and pairs of
/// name=TEXT, stiffness=N/m, damping=N·s/m, friction=MU, sliding=MU (default: 5/6 of friction),
/// texture=none|grain|ridges|bumps, pitch=MM, height=MM, angle=DEGREES; other values do not change. Missing
/// labels in between get the first material's values. Only after read_materials(). Errors: usage for an
/// invalid text; invalid_input for a picture of another shape or with labels without a material.
Result<void> apply_materials(const MaterialArguments& arguments, models::Scene& scene);

}  // namespace palpable::cli
