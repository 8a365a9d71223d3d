// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::vision {
namespace {

enum class Line { row, column };

/// A linear map of the levels of both pictures: `low` becomes 0 and `high` 255.
struct Stretch {
  float low = 0.0F;
  float gain = 255.0F;
  std::uint8_t operator()(float v) const {
    const float level = std::isfinite(v) ? (v - low) * gain : 0.0F;
    return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F);
  }
};

Stretch stretch_for(const Quantiles& left, const Quantiles& right, int bits, double stretch_below) {
  // 8-bit pictures are stretched only if they use few levels; deeper ones always.
  const float low = std::min(left[1], right[1]);
  const float high = std::max(left[kQuantiles - 2], right[kQuantiles - 2]);
  const bool as_it_is = bits == 8 && high - low > static_cast<float>(stretch_below);
  if (as_it_is || high <= low) return {};
  return {low, 255.0F / (high - low)};
}

/// The mean of each row of the picture, or of each column.
std::vector<double> means(const Raster<std::uint8_t>& grey, Line line) {
  std::vector<double> out(static_cast<std::size_t>(line == Line::row ? grey.height() : grey.width()));
  for (int y = 0; y < grey.height(); ++y)
    for (int x = 0; x < grey.width(); ++x)
      out[static_cast<std::size_t>(line == Line::row ? y : x)] += grey(x, y);
  for (double& v : out) v /= static_cast<double>(line == Line::row ? grey.width() : grey.height());
  return out;
}

/// The number of first lines that belong to a dark frame, as in digitised video: much darker than the lines
/// after them.
std::size_t frame_lines(const std::vector<double>& mean, const PreparationOptions& options) {
  const std::size_t most = mean.size() / static_cast<std::size_t>(options.frame_divisor);
  std::size_t lines = 0;
  for (std::size_t k = 1; k <= most; ++k)
    if (mean[k - 1] < options.frame_darkness * mean[k]) lines = k;
  return lines;
}

/// A frame is at the same position in both pictures and would match at infinity, so the nearest inner line
/// replaces it.
void replace_frame(MatchInput& input, const PreparationOptions& options) {
  const auto lines = [&](Line line, bool from_end) {
    std::size_t both = input.left_grey.count();
    for (const auto* grey : {&input.left_grey, &input.right_grey}) {
      std::vector<double> mean = means(*grey, line);
      if (from_end) std::reverse(mean.begin(), mean.end());
      both = std::min(both, frame_lines(mean, options));
    }
    return static_cast<int>(both);
  };
  const int top = lines(Line::row, false);
  const int bottom = lines(Line::row, true);
  const int left = lines(Line::column, false);
  const int right = lines(Line::column, true);
  const auto replace = [&](auto& picture) {
    if (top + bottom + left + right == 0) return;
    const auto whole = picture;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        picture(x, y) = whole(std::clamp(x, left, picture.width() - 1 - right),
                              std::clamp(y, top, picture.height() - 1 - bottom));
  };
  replace(input.left);
  replace(input.right);
  replace(input.left_grey);
  replace(input.right_grey);
}

}  // namespace

MatchInput prepare_pictures(const StereoPair& pair, const Work& work, Exposure* exposure,
                            const PreparationOptions& options) {
  const ExposureMatch match = match_exposures(pair.left, pair.right, options);
  if (exposure != nullptr) *exposure = match.exposure;
  const Quantiles left = luma_quantiles(pair.left);
  const Stretch stretch = stretch_for(left, match.exposure.differs ? left : luma_quantiles(pair.right),
                                      pair.left.bits, options.stretch_below);
  const auto convert = [&](const Image& image, const auto& level, Raster<Rgb8>& colour,
                           Raster<std::uint8_t>& luma) {
    colour = Raster<Rgb8>(image.width, image.height);
    luma = Raster<std::uint8_t>(image.width, image.height);
    const int g = image.channels >= 3 ? 1 : 0;
    const int b = image.channels >= 3 ? 2 : 0;
    parallel_for(work, image.height, 16, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < image.width; ++x) {
          const float* p = image.pixel(x, y);
          std::array<float, 3> v{p[0], p[g], p[b]};
          for (std::size_t c = 0; c < 3; ++c) v[c] = level(match.curves[c], v[c]);
          colour(x, y) = {stretch(v[0]), stretch(v[1]), stretch(v[2])};
          luma(x, y) = stretch(0.299F * v[0] + 0.587F * v[1] + 0.114F * v[2]);
        }
    });
  };
  MatchInput out;
  convert(
      pair.left, [](const LevelCurve& curve, float v) { return curve.clip(v); }, out.left, out.left_grey);
  convert(
      pair.right, [](const LevelCurve& curve, float v) { return curve(v); }, out.right, out.right_grey);
  replace_frame(out, options);
  return out;
}

}  // namespace palpable::vision
