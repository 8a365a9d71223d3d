// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_tactile.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/formats/tactile/height_lines.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/sculpt/contours/outline_polylines.hpp"
#include "palpable/sculpt/relief/heights_above_ground.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace palpable::cli {
namespace {

Result<void> write_text(const Result<std::string>& text, const std::filesystem::path& output) {
  if (!text) return text.error();
  return write_file_atomically(output, std::as_bytes(std::span(*text)));
}

}  // namespace

formats::BrailleOptions braille_options(const TactileArguments& arguments) {
  formats::BrailleOptions options;
  options.columns = arguments.braille_columns;
  options.rows = arguments.braille_rows;
  return options;
}

Result<void> write_dots(const std::vector<Polyline>& lines, double width_m, double height_m,
                        const TactileArguments& arguments, const std::filesystem::path& output) {
  return write_text(output.extension() == ".pbm"
                        ? formats::encode_pins(lines, width_m, height_m, {})
                        : formats::encode_braille(lines, width_m, height_m, braille_options(arguments)),
                    output);
}

Result<void> write_height_lines(const models::Relief& relief, const TactileArguments& arguments,
                                const std::filesystem::path& output, const Work& work) {
  /// Least height of an outline above the ground, and least length of an outline that is felt as an object.
  constexpr double kOutlineShare = 0.04, kLeastLength_m = 0.006;
  formats::HeightLineOptions options;
  options.interval_m = arguments.interval_mm / 1000.0;
  const auto above = sculpt::heights_above_ground(relief, work);
  options.least_length_m = kLeastLength_m;
  if (above) options.outline_m = kOutlineShare * (relief.highest_m() - relief.lowest_m());
  const Raster<float>& heights = above ? *above : relief.samples_m();
  if (output.extension() == ".svg")
    return write_text(formats::encode_height_lines(heights, relief.pixel_m(), options), output);
  // Between two lines of dots a finger needs room.
  constexpr double kMostHeights = 4.0;
  options.interval_m = std::max(options.interval_m, (relief.highest_m() - relief.lowest_m()) / kMostHeights);
  const auto lines = formats::height_polylines(heights, relief.pixel_m(), options);
  if (!lines) return lines.error();
  return write_dots(*lines, relief.size_x_m(), relief.size_y_m(), arguments, output);
}

std::vector<Polyline> outlines_of(const models::Contours& contours) {
  return sculpt::outline_polylines(sculpt::boundary_lines(contours.boundaries),
                                   contours.boundaries.pixel_m());
}

Result<void> write_outlines(const models::Contours& contours, const TactileArguments& arguments,
                            const std::filesystem::path& output) {
  const double width_m = contours.boundaries.size_x_m(), height_m = contours.boundaries.size_y_m();
  if (output.extension() == ".svg") {
    formats::SwellPaperOptions options;
    if (arguments.width_mm) options.width_m = *arguments.width_mm / 1000.0;
    return write_text(formats::encode_swell_paper(outlines_of(contours), width_m, height_m, options), output);
  }
  return write_dots(outlines_of(contours), width_m, height_m, arguments, output);
}

Result<models::Relief> raised_lines(const models::Contours& contours) {
  const models::Relief& grooves = *contours.grooves;
  Raster<float> heights = grooves.samples_m();
  const auto top = static_cast<float>(grooves.highest_m());
  for (float& z : heights.values()) z = top - z;
  return models::Relief::from_samples(std::move(heights), grooves.pixel_m());
}

}  // namespace palpable::cli
