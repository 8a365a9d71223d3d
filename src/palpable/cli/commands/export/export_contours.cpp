// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_contours.hpp"

#include "palpable/cli/commands/export/export_relief.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

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

}  // namespace

Result<Answer> export_contours(const models::Contours& contours, const models::Scene& scene,
                               const ExportArguments& arguments) {
  const std::filesystem::path output(arguments.output);
  const std::string ending = output.extension().string();
  Answer answer;
  answer.json["output"] = arguments.output;
  answer.text = fmt::format("{}\n", arguments.output);
  if (ending == ".stl" || ending == ".glb") {
    const auto plate = arguments.lines == "raised" ? raised_lines(contours) : *contours.grooves;
    if (!plate) return plate.error();
    if (const auto written = write_body(*plate, scene, output); !written) return written.error();
    return answer;
  }
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

}  // namespace palpable::cli
