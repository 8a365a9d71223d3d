// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/formats/tactile/tactile_drawing.hpp"
#include "palpable/models/contours/contours.hpp"
#include "palpable/models/relief/relief.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// Options of `export` for tactile drawings.
struct TactileArguments {
  double interval_mm = 2.0;
  /// Printed width of outlines and maps; default: true size of outlines, 180 mm of maps.
  std::optional<double> width_mm;
  int braille_columns = 40;
  int braille_rows = 25;
  /// A table of liblouis.
  std::string braille_table = "en-ueb-g1.ctb";
};

formats::BrailleOptions braille_options(const TactileArguments& arguments);

/// Lines (metres, the origin in the middle) as .brf for a braille embosser or .pbm for a tactile display of
/// 60 x 40 pins, by the output's suffix. Errors: as the encoders and write_file_atomically().
Result<void> write_dots(const std::vector<Polyline>& lines, double width_m, double height_m,
                        const TactileArguments& arguments, const std::filesystem::path& output);

/// Writes lines of equal height above the relief's ground, first the outlines of the objects on it; without a
/// ground, above its lowest point. As .svg, or as write_dots(), which has room for a few heights only.
/// Errors: as formats::encode_height_lines() and write_file_atomically().
Result<void> write_height_lines(const models::Relief& relief, const TactileArguments& arguments,
                                const std::filesystem::path& output, const Work& work);

/// The outlines of a scene of contours.
std::vector<Polyline> outlines_of(const models::Contours& contours);

/// Writes outlines as .svg for swell paper, or as write_dots(), by the output's suffix.
/// Errors: as the encoders and write_file_atomically().
Result<void> write_outlines(const models::Contours& contours, const TactileArguments& arguments,
                            const std::filesystem::path& output);

/// The plate of the contours' grooves, inverted: lines are raised, for printing and reading by finger.
/// Errors: as Relief::from_samples().
Result<models::Relief> raised_lines(const models::Contours& contours);

}  // namespace palpable::cli
