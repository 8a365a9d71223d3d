// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_map.hpp"

#include "palpable/core/files/atomic_files.hpp"
#include "palpable/describe/map_text.hpp"
#include "palpable/describe/map_words.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/formats/tactile/map_sheet.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/street_selection.hpp"

#include <algorithm>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Braille of lines; without liblouis uncontracted, with a note.
Result<std::vector<formats::BrailleLine>> braille_of(const std::vector<std::string>& lines,
                                                     const std::string& table, Console& console) {
  auto translated = formats::translated_braille(lines, table);
  if (translated || translated.error().code == ErrorCode::usage) return translated;
  console.note(fmt::format("The braille is uncontracted, without accents: {}.", translated.error().message));
  std::vector<formats::BrailleLine> plain;
  for (const std::string& line : lines) plain.push_back(formats::plain_braille(line));
  return plain;
}

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

/// The streets' lines with their keys, and the key in print: what stands above it, and a line for each of the
/// first streets.
struct Drawing {
  formats::MapSheet sheet;
  std::vector<std::string> heading;
  std::vector<std::string> lines;
  /// Streets with names that are not drawn.
  std::size_t not_drawn = 0;
};

/// A name of at most sixty characters, so that a key has a bounded number of pages.
std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 60;
  std::size_t characters = 0;
  for (std::size_t k = 0; k < name.size(); ++k)
    if ((static_cast<unsigned char>(name[k]) & 0xC0U) != 0x80U && ++characters > kMost)
      return name.substr(0, k) + "...";
  return name;
}

Drawing drawing_of(const models::Scene& scene) {
  const describe::MapGuide guide(scene, describe::MapStreets::felt);
  Drawing drawing;
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
    formats::SheetStreet street{{}, formats::plain_braille(keyed.key)};
    for (const auto& run : drawn->runs) street.lines.push_back(line_in_scene(guide, run.line, false));
    drawing.sheet.streets.push_back(std::move(street));
    drawing.lines.push_back(keyed.key + " " + shortened(keyed.name));
  }
  for (const MapStreet& street : map.streets)
    if (street.name.empty())
      drawing.sheet.streets.push_back({{line_in_scene(guide, street.points, false)}, {}});
  for (const MapArea& area : map.areas)
    if (area.kind == MapArea::Kind::water)
      drawing.sheet.waters.push_back(line_in_scene(guide, area.outline, true));
  return drawing;
}

Result<void> add_text(AtomicFiles& files, const std::filesystem::path& path, const std::string& text) {
  return files.add(path, std::as_bytes(std::span(text)));
}

/// "town-key.svg", "town-key-2.svg".
std::filesystem::path key_path(const std::filesystem::path& output, std::size_t page) {
  std::filesystem::path path = output;
  path.replace_filename(output.stem().string() + (page == 0 ? "-key" : fmt::format("-key-{}", page + 1)) +
                        output.extension().string());
  return path;
}

formats::MapSheetOptions sheet_options(const TactileArguments& arguments) {
  formats::MapSheetOptions sheet;
  if (arguments.width_mm) sheet.width_m = *arguments.width_mm / 1000.0;
  return sheet;
}

/// The key in print, without the names that the table cannot write, which are said: first the streets whose
/// keys stand on the drawing.
std::vector<std::string> key_lines(const Drawing& drawing, const std::vector<std::size_t>& without_room,
                                   const std::string& table, Console& console) {
  const auto writable = formats::writable_in_braille(drawing.lines, table);
  std::vector<std::string> lines = drawing.heading, without_key;
  std::size_t unwritable = 0;
  for (std::size_t i = 0; i < drawing.lines.size(); ++i) {
    const bool has_key = std::find(without_room.begin(), without_room.end(), i) == without_room.end();
    if (writable && !(*writable)[i])
      ++unwritable;
    else
      (has_key ? lines : without_key).push_back(drawing.lines[i]);
  }
  if (!without_key.empty()) lines.emplace_back("Streets whose keys are not on the drawing");
  lines.insert(lines.end(), without_key.begin(), without_key.end());
  if (drawing.not_drawn > 0)
    lines.push_back(fmt::format("Streets that are not on the drawing: {}", drawing.not_drawn));
  if (unwritable > 0)
    console.note(fmt::format("{} of {} names cannot be written with {} (--braille-table).", unwritable,
                             drawing.lines.size(), table));
  return lines;
}

constexpr std::size_t kMostSheets = 1000;

/// Sheets of this map's key from an earlier export, beyond those that are written, go.
void remove_older_sheets(const std::filesystem::path& output, std::size_t written, AtomicFiles& files) {
  constexpr std::size_t kBegin = 400;
  for (std::size_t page = written; page < kMostSheets; ++page) {
    const auto path = key_path(output, page);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) continue;
    std::string begin(kBegin, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    begin.resize(static_cast<std::size_t>(file.gcount()));
    if (formats::is_key_sheet(begin)) files.remove_after(path);
  }
}

/// Adds the drawing and, for an SVG, its key; their paths.
Result<std::vector<std::string>> add_drawing(const Drawing& drawing, const TactileArguments& arguments,
                                             const std::filesystem::path& output, Console& console,
                                             AtomicFiles& files) {
  const formats::MapSheetOptions sheet = sheet_options(arguments);
  const formats::BrailleOptions dots = braille_options(arguments);
  const bool is_svg = output.extension() == ".svg";
  // Which keys have room decides the order of the key's lines.
  auto encoded = is_svg ? formats::encode_map_sheet(drawing.sheet, sheet)
                        : formats::encode_map_braille(drawing.sheet, {}, dots);
  if (!encoded) return encoded.error();
  const auto lines = braille_of(key_lines(drawing, encoded->without_room, arguments.braille_table, console),
                                arguments.braille_table, console);
  if (!lines) return lines.error();
  if (!is_svg) encoded = formats::encode_map_braille(drawing.sheet, *lines, dots);
  if (!encoded) return encoded.error();
  std::vector<std::string> paths{output.string()};
  if (const auto added = add_text(files, output, encoded->text); !added) return added.error();
  if (is_svg) {
    const auto pages = formats::encode_key_sheets(*lines, sheet);
    for (std::size_t page = 0; page < pages.size(); ++page) {
      paths.push_back(key_path(output, page).string());
      if (const auto added = add_text(files, paths.back(), pages[page]); !added) return added.error();
    }
    remove_older_sheets(output, pages.size(), files);
  }
  if (!encoded->without_room.empty())
    console.note(fmt::format("{} of {} streets' keys found no room on the drawing; {}.",
                             encoded->without_room.size(), drawing.sheet.streets.size(),
                             is_svg ? "a larger --width or a smaller part of the map has room for more"
                                    : "a smaller part of the map has room for more"));
  return paths;
}

/// The streets on the pins of a tactile display, without keys.
Result<std::string> pins_of(const models::Scene& scene) {
  const formats::PinOptions pins;
  // Lines of pins need two free pins between them.
  const Drawing drawing =
      drawing_of(on_paper(scene, pins.columns * pins.pitch_m, pins.pitch_m, 2.0 * pins.pitch_m));
  std::vector<Polyline> lines;
  for (const formats::SheetStreet& street : drawing.sheet.streets)
    lines.insert(lines.end(), street.lines.begin(), street.lines.end());
  return formats::encode_pins(lines, drawing.sheet.width_m, drawing.sheet.height_m, pins);
}

}  // namespace

bool is_map_drawing(const models::Scene& scene, const std::filesystem::path& output) {
  const auto ending = output.extension();
  return scene.map != nullptr &&
         (ending == ".txt" || ending == ".svg" || ending == ".brf" || ending == ".pbm");
}

std::vector<std::string> map_drawing_files(const std::filesystem::path& output) {
  std::vector<std::string> files{output.string()};
  std::error_code error;
  for (std::size_t page = 0; page < kMostSheets; ++page)
    if (const auto path = key_path(output, page); std::filesystem::exists(path, error))
      files.push_back(path.string());
  return files;
}

Result<Answer> export_map(const models::Scene& scene, const TactileArguments& arguments,
                          const std::filesystem::path& output, Console& console) {
  AtomicFiles files;
  std::vector<std::string> paths{output.string()};
  if (output.extension() == ".txt") {
    if (const auto added = add_text(files, output, describe::map_text(scene)); !added) return added.error();
  } else if (output.extension() == ".pbm") {
    const auto pins = pins_of(scene);
    if (!pins) return pins.error();
    if (const auto added = add_text(files, output, *pins); !added) return added.error();
  } else {
    const bool is_svg = output.extension() == ".svg";
    const formats::BrailleOptions dots = braille_options(arguments);
    const formats::MapSheetOptions lines = sheet_options(arguments);
    // Lines of dots need two free dots between them.
    const models::Scene paper =
        is_svg ? on_paper(scene, lines.width_m, lines.street_m, lines.gap_m)
               : on_paper(scene, dots.columns * dots.cell_m, dots.dot_m, 2.0 * dots.dot_m);
    auto added = add_drawing(drawing_of(paper), arguments, output, console, files);
    if (!added) return added.error();
    paths = *std::move(added);
  }
  if (const auto written = files.commit(); !written) return written.error();
  Answer answer;
  answer.json["output"] = output.string();
  answer.json["files"] = paths;
  answer.text = fmt::format("{}\n", fmt::join(paths, "\n"));
  return answer;
}

}  // namespace palpable::cli
