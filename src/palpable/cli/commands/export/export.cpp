// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/export/export_map.hpp"
#include "palpable/cli/commands/export/export_page.hpp"
#include "palpable/cli/commands/export/export_tactile.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/mesh/glb.hpp"
#include "palpable/formats/mesh/ply.hpp"
#include "palpable/formats/mesh/stl.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/models/relief/relief_solid.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/sculpt/field/field_surface.hpp"
#include "palpable/session/touch/export_recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ExportArguments {
  std::string scene, output;
  TactileArguments tactile;
  std::string lines = "grooves";
  int grid = 128;
  std::string band = "narrow";
};

/// The surface's height at each sample position (the samples are control values).
Raster<float> surface_heights(const models::Relief& relief) {
  Raster<float> heights(relief.samples_m().width(), relief.samples_m().height());
  for (int j = 0; j < heights.height(); ++j) {
    for (int i = 0; i < heights.width(); ++i) {
      const double x = (i - 0.5 * (heights.width() - 1)) * relief.pixel_m();
      const double y = -(j - 0.5 * (heights.height() - 1)) * relief.pixel_m();
      heights(i, j) = static_cast<float>(relief.sample(x, y).z_m);
    }
  }
  return heights;
}

/// Writes heights as 16-bit grey: 0 is the base, 65535 the highest point; the answer gives metres per step.
Result<void> write_heights(const models::Relief& relief, const std::filesystem::path& output,
                           double metres_per_step) {
  const Raster<float> heights = surface_heights(relief);
  Raster<std::uint16_t> grey(heights.width(), heights.height());
  for (std::size_t i = 0; i < heights.count(); ++i) {
    const double step = std::round(static_cast<double>(heights.values()[i]) / metres_per_step);
    grey.values()[i] = static_cast<std::uint16_t>(std::clamp(step, 0.0, 65535.0));
  }
  return formats::write_png(output, grey);
}

Result<void> write_body(const models::Relief& relief, const models::Scene& scene,
                        const std::filesystem::path& output) {
  const Mesh body = models::solid_of(relief);
  auto bytes =
      output.extension() == ".stl" ? formats::encode_stl(body) : formats::encode_glb(body, scene.texture);
  if (!bytes) return bytes.error();
  return write_file_atomically(output, *bytes);
}

std::string sidecar_of(const std::filesystem::path& output) { return output.string() + ".json"; }

/// The files that an export to this one may write.
std::vector<std::string> exported_files(const std::string& output) {
  const auto ending = std::filesystem::path(output).extension();
  if (ending == ".svg") return map_drawing_files(output);
  std::vector<std::string> files{output};
  if (ending == ".png") files.push_back(sidecar_of(output));
  return files;
}

/// Writes what a picture's values mean beside it.
Result<void> write_sidecar(const Json& content, const std::filesystem::path& output) {
  const std::string text = content.dump(2) + "\n";
  return write_file_atomically(sidecar_of(output), std::as_bytes(std::span(text)));
}

/// Writes a sidecar with the settings that `make` needs to read the heights.
Result<void> write_height_sidecar(const models::Relief& relief, const std::filesystem::path& output,
                                  double metres_per_step) {
  return write_sidecar({{"meaning", "nearness"},
                        {"metres_per_step", metres_per_step},
                        {"pixel_m", relief.pixel_m()},
                        {"size_m", {relief.size_x_m(), relief.size_y_m(), relief.highest_m()}}},
                       output);
}

/// Writes the strength of the lines as 16-bit grey (65535 = 1), and beside it what that means and how large
/// it is.
Result<Answer> export_line_picture(const models::BoundaryMap& boundaries, const Raster<float>& lines,
                                   const std::string& output) {
  constexpr double kMost = 65535.0;
  Raster<std::uint16_t> grey(lines.width(), lines.height());
  std::transform(lines.values().begin(), lines.values().end(), grey.values().begin(), [](float s) {
    return static_cast<std::uint16_t>(std::lround(kMost * static_cast<double>(s)));
  });
  if (const auto written = formats::write_png(output, grey); !written) return written.error();
  const Json content{{"values", "line strength"},
                     {"strength_per_step", 1.0 / kMost},
                     {"pixel_m", boundaries.pixel_m()},
                     {"size_m", {boundaries.size_x_m(), boundaries.size_y_m()}}};
  if (const auto written = write_sidecar(content, output); !written) return written.error();
  Answer answer;
  answer.json = {{"output", output},
                 {"strength_per_step", 1.0 / kMost},
                 {"pixel_m", boundaries.pixel_m()},
                 {"sidecar", sidecar_of(output)}};
  answer.text = fmt::format(
      "{0}: strength of the lines as 16-bit grey, 65535 = 1, {1:.4g} mm a pixel, as {0}.json states\n",
      output, 1000.0 * boundaries.pixel_m());
  return answer;
}

Result<Answer> export_model(const models::Relief& relief, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& work) {
  Answer answer;
  answer.json["output"] = arguments.output;
  answer.text = fmt::format("{}\n", arguments.output);
  const std::filesystem::path output(arguments.output);
  const std::string ending = output.extension().string();
  if (ending == ".npz") {
    const formats::Npz arrays{{"height_m", formats::npy_array(surface_heights(relief))},
                              {"pixel_m", formats::npy_array(relief.pixel_m())}};
    if (const auto written = formats::write_npz(output, arrays); !written) return written.error();
    return answer;
  }
  if (ending == ".png") {
    const double metres_per_step = std::max(relief.highest_m(), 1e-9) / 65535.0;
    if (const auto written = write_heights(relief, output, metres_per_step); !written) return written.error();
    if (const auto written = write_height_sidecar(relief, output, metres_per_step); !written)
      return written.error();
    answer.json["metres_per_step"] = metres_per_step;
    answer.json["sidecar"] = sidecar_of(arguments.output);
    answer.text = fmt::format("{0}: heights as 16-bit grey, {1:.6g} mm a step, as {0}.json states\n",
                              arguments.output, 1000.0 * metres_per_step);
    return answer;
  }
  if (ending == ".stl" || ending == ".glb") {
    if (const auto written = write_body(relief, scene, output); !written) return written.error();
    return answer;
  }
  if (ending == ".svg") {
    if (const auto written = write_height_lines(relief, arguments.tactile, output, work); !written)
      return written.error();
    return answer;
  }
  return Error{ErrorCode::usage, "a relief is exported as .stl, .glb, .svg, .npz or .png", arguments.output};
}

/// The spacing for `grid` samples along the field's longest side.
template <models::DistanceSurface Distance>
double spacing_of(const Distance& field, int grid) {
  const Vec3 size = field.size_m();
  return std::max({size.x, size.y, size.z}) / (grid - 1);
}

/// The surface of a field by dual contouring, with one cube per two finest cells.
template <models::DistanceSurface Distance>
Result<Answer> export_surface(const Distance& field, const models::Scene& scene,
                              const ExportArguments& arguments, const Work& work) {
  const std::filesystem::path output(arguments.output);
  constexpr double kCells = 2.0;
  const auto mesh = sculpt::surface_of_field(field, kCells * field.cell_m(), work);
  if (!mesh) return mesh.error();
  const auto bytes = output.extension() == ".stl"   ? formats::encode_stl(*mesh)
                     : output.extension() == ".ply" ? formats::encode_ply(*mesh)
                                                    : formats::encode_glb(*mesh, scene.texture);
  if (!bytes) return bytes.error();
  if (const auto written = write_file_atomically(output, *bytes); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"triangles", mesh->triangles.size()}};
  answer.text = fmt::format("{}: {} triangles\n", arguments.output, mesh->triangles.size());
  return answer;
}

/// A level set for Blender and others, `grid` voxels along the longest side.
template <models::DistanceSurface Distance>
Result<Answer> export_vdb(const Distance& field, const ExportArguments& arguments, const Work& work) {
  formats::VdbOptions options;
  options.voxel_m = spacing_of(field, arguments.grid);
  if (arguments.band == "full") options.band = formats::VdbBand::full;
  const auto bytes = formats::encode_vdb(field, options, work);
  if (!bytes) return Error{bytes.error().code, bytes.error().message, arguments.output};
  if (const auto written = write_file_atomically(arguments.output, *bytes); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"voxel_m", options.voxel_m}, {"bytes", bytes->size()}};
  answer.text =
      fmt::format("{}: a level set, voxels of {:.4g} mm\n", arguments.output, 1000.0 * options.voxel_m);
  return answer;
}

/// Distances on a lattice, `grid` samples along the longest side: distance_m[i, j, k] is at origin_m +
/// spacing_m (i, j, k), x right, y up, z towards the user.
template <models::DistanceSurface Distance>
Result<Answer> export_distances(const Distance& field, const ExportArguments& arguments, const Work& work) {
  const Vec3 origin = field.origin_m(), size = field.size_m();
  const double spacing_m = spacing_of(field, arguments.grid);
  const auto count = [&](double extent) { return static_cast<int>(extent / spacing_m + 1.0 + 1e-9); };
  const int nx = count(size.x), ny = count(size.y), nz = count(size.z);
  std::vector<float> values;
  for (int i = 0; i < nx; ++i) {
    if (work.cancelled()) return Work::interrupted();
    work.report(static_cast<double>(i) / nx, "sampling distances");
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        values.push_back(static_cast<float>(
            field.sample({origin + spacing_m * Vec3{1.0 * i, 1.0 * j, 1.0 * k}}).distance_m));
  }
  formats::NpyArray distances = formats::npy_array(std::span<const float>(values));
  distances.shape = {static_cast<std::size_t>(nx), static_cast<std::size_t>(ny),
                     static_cast<std::size_t>(nz)};
  const std::array<double, 3> origin_m{origin.x, origin.y, origin.z};
  const formats::Npz arrays{{"distance_m", std::move(distances)},
                            {"origin_m", formats::npy_array(std::span<const double>(origin_m))},
                            {"spacing_m", formats::npy_array(spacing_m)}};
  if (const auto written = formats::write_npz(arguments.output, arrays); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"spacing_m", spacing_m}, {"grid", {nx, ny, nz}}};
  answer.text = fmt::format("{}\n", arguments.output);
  return answer;
}

template <models::DistanceSurface Distance>
Result<Answer> export_model(const models::SolidField<Distance>& field, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& work) {
  const std::string ending = std::filesystem::path(arguments.output).extension().string();
  if (ending == ".stl" || ending == ".ply" || ending == ".glb")
    return export_surface(field.distance, scene, arguments, work);
  if (ending == ".vdb") return export_vdb(field.distance, arguments, work);
  if (ending == ".npz") return export_distances(field.distance, arguments, work);
  return Error{ErrorCode::usage, "a field is exported as .stl, .ply, .glb, .vdb or .npz", arguments.output};
}

/// occupied[i, j, k] (0 or 1) is at origin_m + spacing_m (i, j, k), x right, y up, z towards the user.
Result<Answer> export_model(const models::Grid& grid, const models::Scene& /*scene*/,
                            const ExportArguments& arguments, const Work& /*work*/) {
  const std::filesystem::path output(arguments.output);
  if (output.extension() != ".npz")
    return Error{ErrorCode::usage, "a grid is exported as .npz", arguments.output};
  const models::OccupancyGrid& o = grid.occupancy;
  formats::NpyArray occupied;
  occupied.type = formats::NpyType::u1;
  for (const int count : o.counts()) occupied.shape.push_back(static_cast<std::size_t>(count));
  for (int i = 0; i < o.counts()[0]; ++i)
    for (int j = 0; j < o.counts()[1]; ++j)
      for (int k = 0; k < o.counts()[2]; ++k)
        occupied.bytes.push_back(std::byte{o.occupied(i, j, k) ? std::uint8_t{1} : std::uint8_t{0}});
  const std::array<double, 3> origin_m{o.origin_m().x, o.origin_m().y, o.origin_m().z};
  const formats::Npz arrays{{"occupied", std::move(occupied)},
                            {"origin_m", formats::npy_array(std::span<const double>(origin_m))},
                            {"spacing_m", formats::npy_array(o.spacing_m())}};
  if (const auto written = formats::write_npz(output, arrays); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"spacing_m", o.spacing_m()}, {"grid", o.counts()}};
  answer.text = fmt::format("{}\n", arguments.output);
  return answer;
}

/// Exports contours as a plate with grooves or raised lines, as outlines for swell paper or an embosser, or
/// as a picture of the lines. As .npz: unit tangents in image axes (x right, y down; the sign is arbitrary)
/// and strength of the averaged map (eq. 7), and the one-pixel-wide lines.
Result<Answer> export_model(const models::Contours& contours, const models::Scene& scene,
                            const ExportArguments& arguments, const Work& /*work*/) {
  const std::filesystem::path output(arguments.output);
  const std::string ending = output.extension().string();
  Answer answer;
  answer.json["output"] = arguments.output;
  answer.text = fmt::format("{}\n", arguments.output);
  if (ending == ".svg" || ending == ".brf") {
    if (const auto written = write_outlines(contours, arguments.tactile, output); !written)
      return written.error();
    return answer;
  }
  if (ending == ".stl" || ending == ".glb") {
    const auto plate = arguments.lines == "raised" ? raised_lines(contours) : *contours.grooves;
    if (!plate) return plate.error();
    if (const auto written = write_body(*plate, scene, output); !written) return written.error();
    return answer;
  }
  if (ending != ".npz" && ending != ".png")
    return Error{ErrorCode::usage, "contours are exported as .svg, .brf, .stl, .glb, .npz or .png",
                 arguments.output};
  const Raster<float> lines = sculpt::boundary_lines(contours.boundaries);
  if (ending == ".png") return export_line_picture(contours.boundaries, lines, arguments.output);
  const sculpt::TangentMap b = sculpt::tangents_of(contours.boundaries.averaged());
  const formats::Npz arrays{{"tangent_x", formats::npy_array(b.x)},
                            {"tangent_y", formats::npy_array(b.y)},
                            {"strength", formats::npy_array(b.strength)},
                            {"line", formats::npy_array(lines)}};
  if (const auto written = formats::write_npz(output, arrays); !written) return written.error();
  return answer;
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

Result<Answer> run_export(const ExportArguments& arguments, Console& console) {
  const Work work = console.work();
  const auto start = read_file_start(arguments.scene, 8);
  if (!start) return start.error();
  if (has_magic(*start, "PALPREC")) return run_export_recording(arguments, work);
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  if (std::filesystem::path(arguments.output).extension() == ".html")
    return export_page(scene, arguments.output);
  if (is_map_drawing(scene, arguments.output))
    return export_map(scene, arguments.tactile, arguments.output, console);
  return std::visit([&](const auto& model) { return export_model(*model, scene, arguments, work); },
                    scene.model);
}

}  // namespace

void add_export(Program& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  Options options = add_command(
      program, "export", "Write a scene for printers and other programs; a recording as .csv or .npz",
      "  palpable export aloe.palp -o aloe.npz\n"
      "  palpable export aloe.palp -o aloe.stl    for a 3D printer; also .glb\n"
      "  palpable export aloe.palp -o aloe.svg    lines of equal height, for swell paper\n"
      "  palpable export cat.palp -o cat.brf      outlines of contours in braille dots; also .svg, .stl\n"
      "  palpable export town.palp -o town.txt    a map in words; .svg and .brf with keys in braille\n"
      "  palpable export aloe.palp -o heights.png\n"
      "  palpable export aloe.palp -o aloe.html   one page for a phone, that touches the scene by itself\n"
      "  palpable export house.palp -o house.vdb --grid 512    for Blender",
      [arguments](Console& console) { return run_export(*arguments, console); });
  options.argument("SCENE", arguments->scene, "A .palp scene, or a recording of a touch");
  options.required_output(
      "-o,--output", arguments->output,
      {".stl", ".glb", ".ply", ".vdb", ".svg", ".brf", ".txt", ".png", ".npz", ".csv", ".html"},
      "File to write; its suffix selects the format");
  options.last_output_writes(exported_files);
  options.integer("--grid", arguments->grid, {2, 1024},
                  "Field: samples along its longest side in an .npz or .vdb");
  options.choice("--band", arguments->band, {"narrow", "full"},
                 "Field in a .vdb: three voxels on each side of the surface, or also the whole inside");
  TactileArguments& tactile = arguments->tactile;
  options.number("--interval", tactile.interval_mm, {0.1, 100.0},
                 "Relief: difference of height between lines in an .svg, mm");
  options.number("--width", tactile.width_mm, {10.0, 1000.0},
                 "Printed width of an .svg of contours or a map, mm; default true size, of a map 180");
  options.choice("--lines", arguments->lines, {"grooves", "raised"},
                 "Contours: lines as grooves or raised, in an .stl or .glb");
  options.integer("--braille-columns", tactile.braille_columns, {10, 100}, "Cells in a row of a .brf");
  options.integer("--braille-rows", tactile.braille_rows, {5, 100}, "Rows on a page of a .brf");
  options.text("--braille-table", tactile.braille_table,
               "Map: table of liblouis for the names in braille, as en-ueb-g1.ctb or de-g1.ctb");
}

}  // namespace palpable::cli
