// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/range/pair_check.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/census.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 320;   // pictures are shrunk to this or less
constexpr int kSamples = 14;  // along each axis

struct GridPlace {
  int x = 0;
  int y = 0;
};

/// The unique best match of a signature within `reach` rows.
PALPABLE_VECTORIZE std::optional<GridPlace> find_again(std::uint64_t signature,
                                                       const Raster<std::uint64_t>& other, int y, int reach) {
  GridPlace best;
  int best_cost = 64;
  int second = 64;
  for (int v = std::max(kCensusHalfY, y - reach); v <= std::min(other.height() - 1 - kCensusHalfY, y + reach);
       ++v) {
    const auto row = other.row(v);
    for (int u = kCensusHalfX; u < other.width() - kCensusHalfX; ++u) {
      const int cost = __builtin_popcountll(signature ^ row[static_cast<std::size_t>(u)]);
      const bool beside = std::abs(u - best.x) <= 2 && std::abs(v - best.y) <= 2;
      if (cost < best_cost) {
        if (!beside) second = best_cost;
        best_cost = cost;
        best = {u, v};
      } else if (!beside) {
        second = std::min(second, cost);
      }
    }
  }
  if (best_cost > 14 || second < best_cost + 5) return std::nullopt;
  return best;
}

}  // namespace

VerticalOffset measure_vertical_offset(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                       const Work& work) {
  const int factor = (left.width() + kWidth - 1) / kWidth;
  const Raster<std::uint8_t> small = shrunk(left, factor);
  const Raster<std::uint64_t> l = census_9x7(small, work);
  const Raster<std::uint64_t> r = census_9x7(shrunk(right, factor), work);
  const int reach = std::max(2, small.height() / 8);
  Raster<float> found(kSamples, kSamples, std::nanf(""));
  parallel_for(work, kSamples, 1, [&](int begin, int end) {
    for (int j = begin; j < end && !work.cancelled(); ++j) {
      for (int i = 0; i < kSamples; ++i) {
        const int x = small.width() * (2 * i + 1) / (2 * kSamples);
        const int y = small.height() * (2 * j + 1) / (2 * kSamples);
        if (!has_texture(small, x, y)) continue;
        const auto there = find_again(l(x, y), r, y, reach);
        if (!there) continue;
        // Only mutual matches count.
        const auto back = find_again(r(there->x, there->y), l, there->y, reach);
        if (back && std::abs(back->x - x) <= 1 && std::abs(back->y - y) <= 1)
          found(i, j) = static_cast<float>(factor * (there->y - y));
      }
    }
  });
  std::vector<double> offsets;
  for (const float v : found.values())
    if (!std::isnan(v)) offsets.push_back(static_cast<double>(v));
  if (offsets.empty()) return {};
  VerticalOffset out;
  out.found = static_cast<int>(offsets.size());
  out.median_px = quantile_of(offsets, 0.5);
  for (double& v : offsets) v = std::abs(v);
  out.spread_px = quantile_of(offsets, 0.75);
  return out;
}

bool looks_swapped(const DisparityRange& range) { return range.max_px <= 2 && range.min_px < -3; }

std::vector<Parameter> parameters_of(PairCheckOptions& o) {
  return {{"least_agreement", &o.least_agreement, {0, 1}, "", "Agreement of pictures of one scene"},
          {"least_texture", &o.least_texture, {0, 1}, "", "Share of the pixels with texture"},
          {"enough_measured", &o.enough_measured, {0, 1}, "", "Share of measured depth that shows one scene"},
          {"most_guessed", &o.most_guessed, {0, 1}, "", "Share of guessed depth that is reported"},
          {"only_grain", &o.only_grain, {0, 10}, "", "Contrast of a reduced copy below which it is noise"},
          {"least_found", &o.least_found, {1, 200}, "px", "Matched pixels that an offset needs"},
          {"misaligned_px", &o.misaligned_px, {0, 100}, "px", "Spread of the offset that is reported"},
          {"flat_px", &o.flat_px, {0, 100}, "px", "Range of measured disparities that feels flat"}};
}

bool agree(const DisparityRange& range, double measured, const PairCheckOptions& options) {
  return range.agreement >= options.least_agreement || measured >= options.enough_measured;
}

namespace {

/// Mean distance of a pixel from the mean of its window.
double local_contrast(const Raster<std::uint8_t>& grey) {
  double sum = 0.0;
  int all = 0;
  for (int y = kCensusHalfY; y < grey.height() - kCensusHalfY; y += 2)
    for (int x = kCensusHalfX; x < grey.width() - kCensusHalfX; x += 2, ++all) {
      int window = 0;
      for (int v = y - kCensusHalfY; v <= y + kCensusHalfY; ++v)
        for (int u = x - kCensusHalfX; u <= x + kCensusHalfX; ++u) window += grey(u, v);
      sum += std::abs(static_cast<double>(window) / kCensusPixels - grey(x, y));
    }
  return all == 0 ? 0.0 : sum / all;
}

}  // namespace

double contrast_beyond_grain(const Raster<std::uint8_t>& grey) {
  const double own = local_contrast(grey), small = local_contrast(shrunk(grey, 4));
  return own > 0.0 ? small / own : 0.0;
}

std::vector<std::string> pair_notes(const DisparityRange& range, const DisparityRange& matched,
                                    const VerticalOffset& offset, double contrast, double measured,
                                    const PairCheckOptions& options) {
  constexpr const char* kAdvice =
      "so their depth is a guess: light the scene from the side, or lay something "
      "patterned there.";
  std::vector<std::string> notes;
  if (range.textured < options.least_texture) {
    notes.push_back(fmt::format("The pictures show hardly any texture ({:.1f} % of the pixels have some), {}",
                                100.0 * range.textured, kAdvice));
    return notes;
  }
  if (!agree(range, measured, options) && contrast < options.only_grain) {
    notes.push_back(
        fmt::format("The pictures show hardly any texture but a camera's grain ({:.0f} % of their contrast "
                    "is left in a copy "
                    "four times smaller, where pictures of a real scene keep most), {}",
                    100.0 * contrast, kAdvice));
    return notes;
  }
  if (offset.found >= options.least_found && offset.spread_px >= options.misaligned_px)
    notes.push_back(fmt::format(
        "The pictures are not aligned: the right one's content lies {:.0f} pixels {} at the median, "
        "and three quarters of it within {:.0f} pixels of the left one's scanlines.",
        std::abs(offset.median_px), offset.median_px < 0.0 ? "higher" : "lower", offset.spread_px));
  if (!agree(range, measured, options))
    notes.push_back(
        fmt::format("The two pictures show little agreement ({:.1f} % of the textured pixels are found again "
                    "in the other picture), as pictures of different scenes would.",
                    100.0 * range.agreement));
  else if (looks_swapped(range))
    notes.push_back(fmt::format(
        "Left and right seem to be exchanged (disparities from {} to {} pixels); they were matched "
        "the other way round.",
        range.min_px, range.max_px));
  if (agree(range, measured, options) && 1.0 - measured > options.most_guessed)
    notes.push_back(
        fmt::format("The depth of {:.0f} % of the picture is guessed from its surroundings: nothing distinct "
                    "is found there in both "
                    "pictures at disparities from {} to {} pixels, and nearer surfaces are not searched. "
                    "Light the scene from the side, or lay "
                    "something patterned there.",
                    100.0 * (1.0 - measured), matched.min_px, matched.max_px));
  return notes;
}

std::optional<std::string> flat_note(double spread_px, const PairCheckOptions& options) {
  if (spread_px >= options.flat_px) return std::nullopt;
  return fmt::format(
      "Near and far differ by only {:.1f} pixels, so the scene is flat: the two pictures are the same, or "
      "the "
      "camera was turned or zoomed instead of moved.",
      spread_px);
}

}  // namespace palpable::vision
