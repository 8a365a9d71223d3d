// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/scanline.hpp"

#include "palpable/vision/stereo/occlusion/filling.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

// Shi & Pai 1997, section 2 (after Intille & Bobick 1994 and Cox 1992) and section 3.3; docs/stereo.md says
// what was changed and why.
namespace palpable::vision {
namespace {

/// Finds the paths of consecutive scanlines in the left and the right picture's disparity-space images. One
/// object per thread.
class ScanlineMatcher {
 public:
  ScanlineMatcher(const MatchInput& input, const MatchingCost& cost, const Raster<CrossArms>& arms,
                  const ScanlineMapOptions& options, int first_row)
      : input_(input),
        columns_(static_cast<std::size_t>(input.left.width())),
        aggregator_(cost, arms, input.disparities, options.window.column_reach_px, first_row),
        count_(static_cast<std::size_t>(aggregator_.stride())),
        path_(input.left.width(), input.disparities, aggregator_.stride(), options.path),
        costs_(columns_ * count_),
        mirrored_(columns_ * count_),
        right_px_(columns_),
        mirrored_grey_(columns_),
        occluded_(columns_),
        occluded_right_(columns_) {}

  /// The next row's disparities, and whether each pixel is visible in both pictures and confirmed by the
  /// right one.
  void next_row(int y, std::span<float> disparity_px, std::span<std::uint8_t> trusted) {
    aggregator_.next_row(costs_.data());
    path_.find(costs_, input_.left_grey.row(y), disparity_px, occluded_);
    mirror(y);
    path_.find(mirrored_, mirrored_grey_, right_px_, occluded_right_);
    std::reverse(right_px_.begin(), right_px_.end());
    left_right_check_row(disparity_px, right_px_, input_.right_first, trusted);
    for (std::size_t x = 0; x < columns_; ++x)
      if (occluded_[x] != 0) trusted[x] = 0;
  }

 private:
  /// The right picture's disparity-space image is the left one's, sheared and mirrored, so that its path has
  /// the same moves.
  void mirror(int y) {
    const auto grey = input_.right_grey.row(y);
    for (std::size_t m = 0; m < columns_; ++m) {
      const std::size_t x = columns_ - 1 - m;
      mirrored_grey_[m] = grey[x];
      std::uint16_t* out = mirrored_.data() + m * count_;
      const std::uint16_t* from = costs_.data() + x * count_;
      const std::size_t inside = std::min(count_, m + 1);
      for (std::size_t d = 0; d < inside; ++d) out[d] = from[d * (count_ + 1)];
      // Beyond the left picture its last column is repeated.
      std::copy(costs_.end() - static_cast<std::ptrdiff_t>(count_ - inside), costs_.end(), out + inside);
    }
  }

  const MatchInput& input_;
  std::size_t columns_;
  CrossAggregator aggregator_;
  std::size_t count_;  // values per pixel
  ScanlinePath path_;
  std::vector<std::uint16_t> costs_, mirrored_;
  std::vector<float> right_px_;
  std::vector<std::uint8_t> mirrored_grey_, occluded_, occluded_right_;
};

}  // namespace

std::vector<Parameter> parameters_of(ScanlineMapOptions& o) {
  std::vector<Parameter> all;
  append_parameters(all, "cost", parameters_of(o.cost));
  append_parameters(all, "window", parameters_of(o.window));
  append_parameters(all, "path", parameters_of(o.path));
  return all;
}

std::vector<Parameter> parameters_of(ScanlineOptions& o) {
  std::vector<Parameter> all;
  append_parameters(all, "map", parameters_of(o.map));
  append_parameters(all, "columns", parameters_of(o.columns));
  return all;
}

Result<void> check(const ScanlineOptions& options) {
  if (auto ok = check_ranges(options); !ok) return ok;
  return check_window_size(options.map.window);
}

ScanlineMap scanline_map(const MatchInput& input, const ScanlineMapOptions& options, const Work& work) {
  const int width = input.left.width();
  const int height = input.left.height();
  const MatchingCost cost(input, options.cost, work);
  const Raster<CrossArms> arms = cross_arms(cost.left_colour(), options.window, work);
  ScanlineMap out{Raster<float>(width, height), Raster<std::uint8_t>(width, height)};
  // Each part also needs the rows above it within its windows' reach, so parts must not be too small.
  parallel_for(work, height, std::max(1, 4 * options.window.column_reach_px), [&](int begin, int end) {
    ScanlineMatcher matcher(input, cost, arms, options, begin);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      matcher.next_row(y, out.disparity_px.row(y), out.trusted.row(y));
      if (begin == 0 && y % 16 == 0) work.report(static_cast<double>(y) / end, "matching scanlines");
    }
  });
  return out;
}

Result<MatchOutput> match_scanline(const MatchInput& input, const ScanlineOptions& options,
                                   const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  ScanlineMap map = scanline_map(input, options.map, work);
  if (work.cancelled()) return Work::interrupted();
  fill_from_background(map.trusted, map.disparity_px);
  smooth_columns(input.left, map.trusted, options.columns, map.disparity_px, work);
  return MatchOutput{std::move(map.disparity_px), {}};
}

}  // namespace palpable::vision
