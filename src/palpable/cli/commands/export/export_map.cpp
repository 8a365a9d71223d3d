// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_map.hpp"

#include "palpable/cli/commands/export/drawn_names.hpp"
#include "palpable/cli/commands/export/sheet_files.hpp"
#include "palpable/describe/map_text.hpp"
#include "palpable/describe/map_words.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/street_selection.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

Polyline line_in_scene(const describe::MapGuide& guide, const std::vector<MapPoint>& points, bool closed) {
  Polyline line;
  line.closed = closed;
  for (const MapPoint p : points) {
    const describe::Place place = guide.place_of(p);
    line.points.push_back({place.x_m, place.y_m, 0.0});
  }
  return line;
}

/// The scene's map with the streets that a finger can tell apart on paper: lines of this width, this far
/// apart, on a drawing of this width.
models::Scene on_paper(models::Scene scene, double width_m, double line_m, double gap_m) {
  StreetMap map = *scene.map;
  constexpr int kSamples = 1024;
  sculpt::TactileRules rules;
  rules.least_gap_m = gap_m;
  const double height_m = width_m * map.height_px / map.width_px;
  const auto streets = sculpt::select_streets(map, sculpt::map_grid(map, width_m, height_m, kSamples),
                                              {line_m, line_m}, rules);
  for (std::size_t i = 0; i < map.streets.size(); ++i) map.streets[i].felt = streets.felt[i];
  scene.map = std::make_shared<const StreetMap>(std::move(map));
  return scene;
}

/// The streets' lines with their keys, and those of names that persons gave.
KeyedDrawing drawing_of(const models::Scene& scene) {
  const describe::MapGuide guide(scene, describe::MapStreets::felt);
  KeyedDrawing drawing;
  drawing.named = "Streets";
  drawing.sheet.title = "Street map";
  const StreetMap& map = guide.map();
  drawing.sheet.width_m = guide.metres_on_device(map.width_px);
  drawing.sheet.height_m = guide.metres_on_device(map.height_px);
  drawing.heading.push_back(shortened(describe::name_of(scene)));
  if (map.metres_per_px > 0.0)
    drawing.heading.push_back(fmt::format("{:.0f} by {:.0f} metres, north is up",
                                          map.width_px * map.metres_per_px,
                                          map.height_px * map.metres_per_px));
  for (const describe::KeyedStreet& keyed : describe::keyed_streets(scene)) {
    const auto drawn = std::find_if(guide.streets().begin(), guide.streets().end(),
                                    [&](const auto& street) { return street.name == keyed.name; });
    if (drawn == guide.streets().end()) {
      ++drawing.not_drawn;
      continue;
    }
    formats::SheetStroke street{{}, formats::plain_braille(keyed.key)};
    for (const auto& run : drawn->runs) street.lines.push_back(line_in_scene(guide, run.line, false));
    drawing.sheet.strokes.push_back(std::move(street));
    drawing.key_lines.push_back(keyed.key + " " + shortened(keyed.name));
  }
  add_written_names(scene, drawing);
  for (const MapStreet& street : map.streets)
    if (street.name.empty())
      drawing.sheet.strokes.push_back({{line_in_scene(guide, street.points, false)}, {}});
  for (const MapArea& area : map.areas)
    if (area.kind == MapArea::Kind::water)
      drawing.sheet.waters.push_back(line_in_scene(guide, area.outline, true));
  return drawing;
}

/// The streets on the pins of a tactile display, without keys.
Result<std::string> pins_of(const models::Scene& scene) {
  const formats::PinOptions pins;
  // Lines of pins need two free pins between them.
  const auto sheet =
      drawing_of(on_paper(scene, pins.columns * pins.pitch_m, pins.pitch_m, 2.0 * pins.pitch_m)).sheet;
  return formats::encode_pins(formats::lines_of(sheet), sheet.width_m, sheet.height_m, pins);
}

}  // namespace

bool is_map_drawing(const models::Scene& scene, const std::filesystem::path& output) {
  return scene.map != nullptr && (output.extension() == ".txt" || is_drawing(output));
}

Result<Answer> export_map(const models::Scene& scene, const TactileArguments& arguments,
                          const std::filesystem::path& output, Console& console) {
  const auto ending = output.extension();
  if (ending == ".txt") return write_text(describe::map_text(scene), output);
  if (ending == ".pbm") return write_text(pins_of(scene), output);
  constexpr double kWidth_m = 0.18;
  const double width_px = scene.map->width_px, height_px = scene.map->height_px;
  const auto options = print_options(arguments, width_px, height_px, kWidth_m);
  if (!options) return options.error();
  const auto& [sheet, dots, table] = *options;
  // Lines of dots need two free dots between them.
  const models::Scene paper =
      ending == ".svg"
          ? on_paper(scene, formats::printed_width_m(width_px, height_px, sheet), sheet.line_m, sheet.gap_m)
          : on_paper(scene, dots.columns * dots.cell_m, dots.dot_m, 2.0 * dots.dot_m);
  return write_drawing(drawing_of(paper), *options, output, console);
}

}  // namespace palpable::cli
