// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_relief.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/formats/mesh/glb.hpp"
#include "palpable/formats/mesh/stl.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/models/relief/relief_solid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

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

/// Writes a sidecar with the settings that `make` needs to read the heights.
Result<void> write_height_sidecar(const models::Relief& relief, const std::filesystem::path& output,
                                  double metres_per_step) {
  return write_sidecar({{"meaning", "nearness"},
                        {"metres_per_step", metres_per_step},
                        {"pixel_m", relief.pixel_m()},
                        {"size_m", {relief.size_x_m(), relief.size_y_m(), relief.highest_m()}}},
                       output);
}

}  // namespace

std::string sidecar_of(const std::filesystem::path& output) { return output.string() + ".json"; }

Result<void> write_sidecar(const Json& content, const std::filesystem::path& output) {
  const std::string text = content.dump(2) + "\n";
  return write_file_atomically(sidecar_of(output), std::as_bytes(std::span(text)));
}

Result<void> write_body(const models::Relief& relief, const models::Scene& scene,
                        const std::filesystem::path& output) {
  const Mesh body = models::solid_of(relief);
  auto bytes =
      output.extension() == ".stl" ? formats::encode_stl(body) : formats::encode_glb(body, scene.texture);
  if (!bytes) return bytes.error();
  return write_file_atomically(output, *bytes);
}

Result<Answer> export_relief(const models::Relief& relief, const models::Scene& scene,
                             const ExportArguments& arguments) {
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
  if (const auto written = write_body(relief, scene, output); !written) return written.error();
  return answer;
}

}  // namespace palpable::cli
