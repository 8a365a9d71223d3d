// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/sheet_files.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/contours/contours.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace palpable::cli {

/// Options of `export` for tactile drawings.
struct TactileArguments {
  /// From one height to the next; default: 2 mm, of a solid or grid a quarter of its height.
  std::optional<double> interval_mm;
  /// Printed width of an .svg; default: true size, of maps 180 mm; solids and grids are fitted to A4.
  std::optional<double> width_mm;
  /// "none", "A4" or "A3".
  std::string paper = "none";
  /// Of a .brf; default: 40 and 25.
  std::optional<int> braille_columns;
  std::optional<int> braille_rows;
  /// A table of liblouis.
  std::string braille_table = "en-ueb-g1.ctb";
};

/// How a drawing of these proportions is printed, `width_m` wide unless the arguments say otherwise.
/// Errors: usage for a paper together with other sizes.
Result<PrintOptions> print_options(const TactileArguments& arguments, double width, double height,
                                   double width_m);

/// Whether this is a tactile drawing, by its suffix.
bool is_drawing(const std::filesystem::path& output);

/// Writes any scene but a map as a tactile drawing: contours as their lines, others seen from above as lines
/// of equal height, of which the first is the outline of what stands on the ground. Those of a relief are
/// above its own ground; without one, above its lowest point. As write_drawing(), with keys of the names that
/// persons gave and of the regions with a name; or as .pbm for a tactile display of 60 x 40 pins. Dots and
/// pins have room for a few heights only. Errors: as formats::height_lines() and write_drawing().
Result<Answer> export_drawing(const models::Scene& scene, const TactileArguments& arguments,
                              const std::filesystem::path& output, Console& console);

/// The plate of the contours' grooves, inverted: lines are raised, for printing and reading by finger.
/// Errors: as Relief::from_samples().
Result<models::Relief> raised_lines(const models::Contours& contours);

}  // namespace palpable::cli
