// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/polyline.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/contours/contours.hpp"
#include "palpable/models/relief/relief.hpp"

#include <filesystem>
#include <vector>

namespace palpable::cli {

/// What the options of `export` say of drawings for fingers.
struct TactileArguments {
  double interval_mm = 2.0;
  /// Printed width of outlines; 0 = true size.
  double width_mm = 0.0;
  int braille_columns = 40;
  int braille_rows = 25;
};

/// Lines of equal height above the relief's ground, the outlines of what rises from it first; without a
/// ground, above its lowest place. Errors: as formats::encode_contour_lines() and write_file_atomically().
Result<void> write_height_lines(const models::Relief& relief, const TactileArguments& arguments,
                                const std::filesystem::path& output, const Work& work);

/// The outlines of a scene of contours.
std::vector<Polyline> outlines_of(const models::Contours& contours);

/// Outlines as .svg for swell paper, or as .brf for a braille embosser, by the output's ending. Errors: usage
/// for another ending; as the encoders and write_file_atomically().
Result<void> write_outlines(const models::Contours& contours, const TactileArguments& arguments,
                            const std::filesystem::path& output);

/// The plate of the contours' grooves turned over: lines stand out, to be printed and read by finger. Errors:
/// as Relief::from_samples().
Result<models::Relief> raised_lines(const models::Contours& contours);

}  // namespace palpable::cli
