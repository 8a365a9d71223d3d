// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/disparity_file.hpp"

#include "palpable/core/image.hpp"
#include "palpable/core/read_file.hpp"
#include "palpable/sources/depth_file.hpp"
#include "palpable/sources/picture.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::cli {

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
  return std::move(read->disparity.disparity_px);
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
