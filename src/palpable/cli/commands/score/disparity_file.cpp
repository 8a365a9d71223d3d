// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/score/disparity_file.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::cli {
namespace {

/// Whether some disparities are known and all are below a pixel.
bool all_below_a_pixel(const Raster<float>& disparity_px) {
  float greatest = 0.0F;
  for (const float d : disparity_px.values())
    if (d > greatest) greatest = d;
  return greatest > 0.0F && greatest < 1.0F;
}

}  // namespace

Result<Raster<float>> read_disparity(const std::filesystem::path& file, std::optional<double> scale) {
  constexpr std::size_t kEnoughToRecognise = 64;
  constexpr double kOwnPngScale = 256.0;
  const auto start = read_file_start(file, kEnoughToRecognise);
  if (!start) return start.error();
  const auto format = sources::picture_format_of(*start);
  const bool floats = !format || *format == sources::PictureFormat::pfm;
  auto read = sources::read_disparity(
      file, 1.0 / scale.value_or(floats ? 1.0 : kOwnPngScale),
      floats ? sources::UnknownDisparity::not_finite : sources::UnknownDisparity::zero_too);
  if (!read) return read.error();
  Raster<float>& disparity_px = read->disparity.disparity_px;
  if (!floats && !scale && all_below_a_pixel(disparity_px))
    return invalid_input(
        "a picture of disparity is taken as 256ths of a pixel, but then all of this one lies below a pixel: "
        "state its scale (such as --truth-scale 4)",
        file.string());
  return std::move(disparity_px);
}

Result<Raster<std::uint8_t>> read_mask(const std::filesystem::path& file) {
  const auto picture = sources::read_picture(file);
  if (!picture) return picture.error();
  const Raster<float> values = grey(*picture);
  Raster<std::uint8_t> mask(values.width(), values.height());
  for (std::size_t i = 0; i < mask.count(); ++i)
    mask.values()[i] =
        static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(values.values()[i], 0.0F, 1.0F)));
  return mask;
}

}  // namespace palpable::cli
