// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_tactile.hpp"

#include "palpable/cli/commands/export/drawn_names.hpp"
#include "palpable/formats/tactile/braille_cells.hpp"
#include "palpable/formats/tactile/height_lines.hpp"
#include "palpable/formats/tactile/tactile_drawing.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/sculpt/contours/outline_polylines.hpp"
#include "palpable/sculpt/relief/heights_above_ground.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace palpable::cli {
namespace {

/// What the drawings of one kind of file have room for.
struct Medium {
  /// Most heights; unlimited if not given.
  std::optional<double> most_heights;
  /// Finer detail of the surface is smoothed away, in the scene.
  double smooth_m = 0.0;
};

Medium medium_of(const std::filesystem::path& output, const PrintOptions& print, double width_m,
                 double height_m) {
  if (output.extension() == ".svg") {
    constexpr double kOnPaper_m = 0.0015;
    return {{}, kOnPaper_m * width_m / formats::printed_width_m(width_m, height_m, print.sheet)};
  }
  if (output.extension() == ".brf") return {4.0, width_m / print.braille.columns};
  constexpr double kPins = 0.7;
  return {3.0, kPins * formats::pin_pitch_on(width_m, height_m, {})};
}

/// The heights that are drawn, and where the outline of what stands on the ground is.
struct Heights {
  Raster<float> heights_m;
  formats::HeightLineOptions lines;
};

/// A solid or a grid stands on its own lowest point, which its view from above has all around it.
Heights heights_of_solid(const models::Relief& from_above, const TactileArguments& arguments) {
  constexpr double kHeights = 4.0, kOutlineShare = 0.02;
  const double lowest_m = from_above.lowest_m(), range_m = from_above.highest_m() - lowest_m;
  Heights out{from_above.samples_m(), {}};
  for (float& z : out.heights_m.values()) z -= static_cast<float>(lowest_m);
  out.lines.interval_m = arguments.interval_mm ? *arguments.interval_mm / 1000.0 : range_m / kHeights;
  out.lines.outline_m = kOutlineShare * range_m;
  // The picture ends where the solid does.
  out.lines.beyond = formats::HeightLineOptions::Beyond::lowest;
  return out;
}

Heights heights_of_relief(const models::Relief& relief, const TactileArguments& arguments, const Work& work) {
  constexpr double kInterval_mm = 2.0, kOutlineShare = 0.04;
  auto above = sculpt::heights_above_ground(relief, work);
  Heights out{above ? *std::move(above) : relief.samples_m(), {}};
  out.lines.interval_m = arguments.interval_mm.value_or(kInterval_mm) / 1000.0;
  if (above) out.lines.outline_m = kOutlineShare * (relief.highest_m() - relief.lowest_m());
  return out;
}

Result<std::vector<formats::SheetStroke>> height_strokes(const models::Scene& scene, const Medium& medium,
                                                         const TactileArguments& arguments,
                                                         const Work& work) {
  /// Shorter lines are not felt as objects.
  constexpr double kLeastLength = 0.06;
  const models::Relief& relief = *models::relief_of(scene);
  const bool is_relief = std::holds_alternative<std::shared_ptr<const models::Relief>>(scene.model);
  Heights heights =
      is_relief ? heights_of_relief(relief, arguments, work) : heights_of_solid(relief, arguments);
  heights.lines.least_length_m = kLeastLength * std::max(relief.size_x_m(), relief.size_y_m());
  heights.lines.smooth_m = medium.smooth_m;
  if (medium.most_heights)
    heights.lines.interval_m =
        std::max(heights.lines.interval_m, (relief.highest_m() - relief.lowest_m()) / *medium.most_heights);
  auto lines = formats::height_lines(heights.heights_m, relief.pixel_m(), heights.lines);
  if (!lines) return lines.error();
  std::vector<formats::SheetStroke> strokes;
  for (formats::HeightLine& line : *lines) strokes.push_back({{std::move(line.line)}, {}, line.weight});
  return strokes;
}

/// The longest first.
std::vector<formats::SheetStroke> contour_strokes(const models::Contours& contours) {
  auto lines =
      sculpt::outline_polylines(sculpt::boundary_lines(contours.boundaries), contours.boundaries.pixel_m());
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Polyline& a, const Polyline& b) { return length_of(a) > length_of(b); });
  std::vector<formats::SheetStroke> strokes;
  for (Polyline& line : lines) strokes.push_back({{std::move(line)}});
  return strokes;
}

Result<std::string> pins_of(const formats::TactileSheet& sheet) {
  formats::PinOptions pins;
  pins.spacing = formats::LineSpacing::spaced;
  return formats::encode_pins(formats::lines_of(sheet), sheet.width_m, sheet.height_m, pins);
}

}  // namespace

Result<PrintOptions> print_options(const TactileArguments& arguments, double width, double height,
                                   double width_m) {
  if (auto known = formats::check_braille_table(arguments.braille_table); !known) return known.error();
  PrintOptions options;
  options.table = arguments.braille_table;
  options.sheet.width_m = arguments.width_mm ? *arguments.width_mm / 1000.0 : width_m;
  if (arguments.braille_columns) options.braille.columns = *arguments.braille_columns;
  if (arguments.braille_rows) options.braille.rows = *arguments.braille_rows;
  if (arguments.paper == "none") return options;
  if (arguments.width_mm || arguments.braille_columns || arguments.braille_rows)
    return Error{ErrorCode::usage,
                 "the paper sets the size: leave out --width, --braille-columns and --braille-rows",
                 "--paper"};
  options.sheet.paper = arguments.paper == "A4" ? formats::Paper::a4 : formats::Paper::a3;
  options.braille = formats::braille_on(*options.sheet.paper, width, height);
  return options;
}

bool is_drawing(const std::filesystem::path& output) {
  const auto ending = output.extension();
  return ending == ".svg" || ending == ".brf" || ending == ".pbm";
}

Result<Answer> export_drawing(const models::Scene& scene, const TactileArguments& arguments,
                              const std::filesystem::path& output, Console& console) {
  constexpr double kOutline_m = 0.0012, kHeight_m = 0.0008;
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model);
  const bool has_true_size =
      contours != nullptr || std::holds_alternative<std::shared_ptr<const models::Relief>>(scene.model);
  KeyedDrawing drawing;
  drawing.sheet.title = contours != nullptr ? "Outlines" : "Lines of equal height";
  const double width_m =
      contours != nullptr ? (*contours)->boundaries.size_x_m() : models::relief_of(scene)->size_x_m();
  const double height_m =
      contours != nullptr ? (*contours)->boundaries.size_y_m() : models::relief_of(scene)->size_y_m();
  drawing.sheet.width_m = width_m;
  drawing.sheet.height_m = height_m;
  auto options = print_options(arguments, width_m, height_m, width_m);
  if (!options) return options.error();
  // Buildings have their own size, in metres.
  if (!has_true_size && !arguments.width_mm && !options->sheet.paper)
    options->sheet.paper = formats::Paper::a4;
  options->sheet.line_m = contours != nullptr ? kOutline_m : kHeight_m;
  options->sheet.spacing = options->braille.spacing = formats::LineSpacing::spaced;
  if (contours != nullptr) {
    drawing.sheet.strokes = contour_strokes(**contours);
  } else {
    auto lines =
        height_strokes(scene, medium_of(output, *options, width_m, height_m), arguments, console.work());
    if (!lines) return lines.error();
    drawing.sheet.strokes = *std::move(lines);
  }
  if (output.extension() == ".pbm") return write_text(pins_of(drawing.sheet), output);
  add_names(scene, drawing);
  return write_drawing(drawing, *options, output, console);
}

Result<models::Relief> raised_lines(const models::Contours& contours) {
  const models::Relief& grooves = *contours.grooves;
  Raster<float> heights = grooves.samples_m();
  const auto top = static_cast<float>(grooves.highest_m());
  for (float& z : heights.values()) z = top - z;
  return models::Relief::from_samples(std::move(heights), grooves.pixel_m());
}

}  // namespace palpable::cli
