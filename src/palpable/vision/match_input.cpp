// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/match_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::vision {
namespace {

constexpr std::size_t kLevels = 256;

enum class Line { row, column };
using Levels = std::array<float, kLevels>;

/// The picture's levels at the quantiles 0, 1/255 … 1 of its luma.
Levels quantiles(const Raster<float>& luma) {
  std::vector<float> sorted(luma.values().begin(), luma.values().end());
  std::erase_if(sorted, [](float v) { return !std::isfinite(v); });
  Levels out{};
  if (sorted.empty()) return out;
  // Every pixel of a large picture adds nothing to 256 quantiles.
  const std::size_t step = std::max<std::size_t>(1, sorted.size() / 16384);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sorted.size(); i += step) sorted[kept++] = sorted[i];
  sorted.resize(kept);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t q = 0; q < kLevels; ++q) out[q] = sorted[(sorted.size() - 1) * q / (kLevels - 1)];
  return out;
}

/// `v` mapped by the monotone curve through (from[q], to[q]); beyond its ends the curve goes on in parallel.
float mapped(float v, const Levels& from, const Levels& to) {
  if (v <= from.front()) return to.front() + (v - from.front());
  if (v >= from.back()) return to.back() + (v - from.back());
  const auto above = std::upper_bound(from.begin(), from.end(), v);
  const auto i = static_cast<std::size_t>(above - from.begin());
  const float t = (v - from[i - 1]) / (from[i] - from[i - 1]);
  return to[i - 1] + t * (to[i] - to[i - 1]);
}

/// Levels of both pictures so that `low` becomes 0 and `high` 255.
struct Stretch {
  float low = 0.0F;
  float gain = 255.0F;
  std::uint8_t operator()(float v) const {
    const float level = std::isfinite(v) ? (v - low) * gain : 0.0F;
    return static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F);
  }
};

Stretch stretch_for(const Levels& left, const Levels& right, int bits) {
  // 8-bit pictures are taken as they are unless they are very dark; deeper ones are stretched to what they
  // use.
  const float low = std::min(left[1], right[1]);
  const float high = std::max(left[kLevels - 2], right[kLevels - 2]);
  const bool as_it_is = bits == 8 && high - low > 0.4F;
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

/// How many of the first lines are the dark frame that digitised video has: far darker on the whole than
/// those after them, at most a sixtieth of the picture.
std::size_t frame_lines(const std::vector<double>& mean) {
  constexpr double kFarDarker = 0.6;
  const std::size_t most = mean.size() / 60;
  std::size_t lines = 0;
  for (std::size_t k = 1; k <= most; ++k)
    if (mean[k - 1] < kFarDarker * mean[k]) lines = k;
  return lines;
}

/// A frame stands still in both pictures, and matching would take it for something infinitely far: the
/// nearest line inside takes its place.
void cut_frame(MatchInput& input) {
  const auto lines = [&](Line line, bool from_end) {
    std::size_t both = input.left_grey.count();
    for (const auto* grey : {&input.left_grey, &input.right_grey}) {
      std::vector<double> mean = means(*grey, line);
      if (from_end) std::reverse(mean.begin(), mean.end());
      both = std::min(both, frame_lines(mean));
    }
    return static_cast<int>(both);
  };
  const int top = lines(Line::row, false);
  const int bottom = lines(Line::row, true);
  const int left = lines(Line::column, false);
  const int right = lines(Line::column, true);
  const auto cut = [&](auto& picture) {
    if (top + bottom + left + right == 0) return;
    const auto whole = picture;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        picture(x, y) = whole(std::clamp(x, left, picture.width() - 1 - right),
                              std::clamp(y, top, picture.height() - 1 - bottom));
  };
  cut(input.left);
  cut(input.right);
  cut(input.left_grey);
  cut(input.right_grey);
}

}  // namespace

MatchInput prepare_pictures(const StereoPair& pair, const Work& work, bool* levelled) {
  const Levels left = quantiles(grey(pair.left));
  const Levels right = quantiles(grey(pair.right));
  // The middle of the histograms: their ends move with what only one of the cameras sees.
  float difference = 0.0F;
  for (std::size_t q = 26; q <= 230; ++q) difference += std::abs(left[q] - right[q]) / 205.0F;
  const float used = std::max(left[230] - left[26], right[230] - right[26]);
  const bool differs = difference > 0.08F * used;
  if (levelled != nullptr) *levelled = differs;

  const Stretch stretch = stretch_for(left, differs ? left : right, pair.left.bits);
  const auto convert = [&](const Image& image, bool level, Raster<Rgb8>& colour, Raster<std::uint8_t>& luma) {
    colour = Raster<Rgb8>(image.width, image.height);
    luma = Raster<std::uint8_t>(image.width, image.height);
    const int g = image.channels >= 3 ? 1 : 0;
    const int b = image.channels >= 3 ? 2 : 0;
    parallel_for(work, image.height, 16, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < image.width; ++x) {
          const float* p = image.pixel(x, y);
          std::array<float, 3> v{p[0], p[g], p[b]};
          if (level)
            for (float& c : v) c = mapped(c, right, left);
          colour(x, y) = {stretch(v[0]), stretch(v[1]), stretch(v[2])};
          luma(x, y) = stretch(0.299F * v[0] + 0.587F * v[1] + 0.114F * v[2]);
        }
    });
  };
  MatchInput out;
  convert(pair.left, false, out.left, out.left_grey);
  convert(pair.right, differs, out.right, out.right_grey);
  cut_frame(out);
  return out;
}

}  // namespace palpable::vision
