// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_arguments.hpp"
#include "palpable/cli/commands/export/export_contours.hpp"
#include "palpable/cli/commands/export/export_field.hpp"
#include "palpable/cli/commands/export/export_formats.hpp"
#include "palpable/cli/commands/export/export_grid.hpp"
#include "palpable/cli/commands/export/export_map.hpp"
#include "palpable/cli/commands/export/export_page.hpp"
#include "palpable/cli/commands/export/export_relief.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/session/touch/export_recording.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// The files that an export to this one may write.
std::vector<std::string> exported_files(const std::string& output) {
  const auto ending = std::filesystem::path(output).extension();
  if (ending == ".svg") return drawing_files(output);
  std::vector<std::string> files{output};
  if (ending == ".png") files.push_back(sidecar_of(output));
  return files;
}

Result<Answer> run_export_recording(const ExportArguments& arguments, const Work& work) {
  const auto recording = session::export_recording(arguments.scene, arguments.output, work);
  if (!recording) return recording.error();
  Answer answer;
  answer.json["output"] = arguments.output;
  answer.json["ticks"] = recording->ticks;
  answer.json["lost"] = recording->lost;
  answer.json["complete"] = recording->complete;
  answer.text =
      fmt::format("{}: {} ticks{}\n", arguments.output, recording->ticks,
                  recording->complete ? "" : "; the recording was cut off there: its end mark is missing");
  return answer;
}

/// The model's own exports; tactile drawings and the page are not among them.
struct ModelExport {
  const models::Scene& scene;
  const ExportArguments& arguments;
  const Work& work;

  Result<Answer> operator()(const std::shared_ptr<const models::Relief>& relief) const {
    return export_relief(*relief, scene, arguments);
  }
  Result<Answer> operator()(const std::shared_ptr<const models::Contours>& contours) const {
    return export_contours(*contours, scene, arguments);
  }
  Result<Answer> operator()(const std::shared_ptr<const models::Grid>& grid) const {
    return export_grid(*grid, arguments.output);
  }
  template <class Field>
  Result<Answer> operator()(const std::shared_ptr<const Field>& field) const {
    return export_field(*field, scene, arguments, work);
  }
};

Result<Answer> run_export(const ExportArguments& arguments, Console& console) {
  const Work work = console.work();
  const auto start = read_file_start(arguments.scene, 8);
  if (!start) return start.error();
  const auto check = [&](Exported what) -> Result<void> {
    if (auto checked = check_export(what, arguments.output); !checked) return checked;
    if (const auto unread = note_on_unread(what, arguments.output, arguments.given())) console.note(*unread);
    return {};
  };
  if (has_magic(*start, "PALPREC")) {
    if (auto checked = check(Exported::recording); !checked) return std::move(checked).error();
    return run_export_recording(arguments, work);
  }
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  if (auto checked = check(exported_kind(scene)); !checked) return std::move(checked).error();
  if (std::filesystem::path(arguments.output).extension() == ".html")
    return export_page(scene, arguments.output);
  if (is_map_drawing(scene, arguments.output))
    return export_map(scene, arguments.tactile, arguments.output, console);
  if (is_drawing(arguments.output))
    return export_drawing(scene, arguments.tactile, arguments.output, console);
  return std::visit(ModelExport{scene, arguments, work}, scene.model);
}

}  // namespace

void add_export(Program& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  Options options = add_command(
      program, "export",
      "Write a scene for printers, phones (.html) and other programs; a recording as .csv or .npz",
      "  palpable export aloe.palp -o aloe.npz\n"
      "  palpable export aloe.palp -o aloe.stl    for a 3D printer; also .glb\n"
      "  palpable export aloe.palp -o aloe.svg --paper A4    lines of equal height, for swell paper\n"
      "  palpable export cat.palp -o cat.brf      outlines of contours in braille dots; also .svg, .stl\n"
      "  palpable export cat.palp -o cat.pbm      the same on the pins of a tactile display, 60 x 40\n"
      "  palpable export town.palp -o town.txt    a map in words; .svg and .brf with keys in braille\n"
      "  palpable export aloe.palp -o heights.png\n"
      "  palpable export aloe.palp -o aloe.html   one page for a phone, that touches the scene by itself\n"
      "  palpable export house.palp -o house.vdb --grid 512    for Blender",
      [arguments](Console& console) { return run_export(*arguments, console); });
  arguments->given = options.given();
  options.argument("SCENE", arguments->scene, "A .palp scene, or a recording of a touch");
  options.required_output("-o,--output", arguments->output, export_suffixes(),
                          "File to write; its suffix selects the format");
  options.last_output_writes(exported_files);
  options.integer("--grid", arguments->grid, {2, 1024},
                  "Field: samples along its longest side in an .npz or .vdb");
  options.choice("--band", arguments->band, {"narrow", "full"},
                 "Field in a .vdb: three voxels on each side of the surface, or also the whole inside");
  TactileArguments& tactile = arguments->tactile;
  options.number(
      "--interval", tactile.interval_mm, {0.1, 100.0},
      "Difference of height between lines of a drawing, mm; default 2, of a solid or grid a quarter of "
      "its height");
  options.number(
      "--width", tactile.width_mm, {10.0, 1000.0},
      "Printed width of an .svg, mm; default true size, of a map 180, of a solid or grid as large as A4 "
      "allows");
  options.choice("--paper", tactile.paper, {"none", "A4", "A3"},
                 "Paper that an .svg or .brf is made as large as possible for, upright or across");
  options.choice("--lines", arguments->lines, {"grooves", "raised"},
                 "Contours: lines as grooves or raised, in an .stl or .glb");
  options.integer("--braille-columns", tactile.braille_columns, {10, 100},
                  "Cells in a row of a .brf; default 40");
  options.integer("--braille-rows", tactile.braille_rows, {5, 100}, "Rows on a page of a .brf; default 25");
  options.text("--braille-table", tactile.braille_table,
               "Table of liblouis for the names in braille, as en-ueb-g1.ctb or de-g1.ctb");
}

}  // namespace palpable::cli
