// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/fast.hpp"

#include "palpable/core/vectorize.hpp"
#include "palpable/vision/image/median.hpp"
#include "palpable/vision/stereo/cost/least_cost.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"
#include "palpable/vision/stereo/cost/path_costs.hpp"
#include "palpable/vision/stereo/cost/sub_pixel.hpp"
#include "palpable/vision/stereo/occlusion/consistency.hpp"
#include "palpable/vision/stereo/occlusion/left_right.hpp"

#include <array>
#include <cmath>
#include <memory>

namespace palpable::vision {
namespace {

/// Of the greatest colour difference of the three channels so much counts, and so much beside a census bit;
/// half the sum of both is the cost.
constexpr CostOptions kCost{.census_weight = 1, .colour_limit = 20, .colour_weight = 3, .halvings = 1};
static_assert((63 + kCost.colour_limit * kCost.colour_weight) / 2 <= kLargestCost);
/// Costs are averaged with those of neighbours 1, 2 and 4 columns and 1 and 2 rows away whose colour is
/// alike.
constexpr int kColumnPasses = 3;
constexpr int kRowPasses = 2;
constexpr int kReach = 1 << (kRowPasses - 1);
constexpr int kRing = 2 * kReach + 1;
constexpr std::uint8_t kAlike = 20;
/// A large step between pixels of one colour, its least across an edge, and how fast it falls between.
constexpr float kLargeStep = 120.0F;
constexpr float kLeastLargeStep = 14.0F;
constexpr float kLikeColour = 12.0F;
/// Pictures are matched in an even number of stripes of at most half so many rows, the same for any number of
/// threads; so many rows above and below lead its paths in.
constexpr int kTwoStripes = 400;
constexpr int kLeadIn = 12;

using Bytes = std::vector<std::uint8_t>;

/// (a + 2 b + c) / 4, rounded up and down.
PALPABLE_VECTORIZE void smooth(const std::uint8_t* __restrict a, const std::uint8_t* __restrict b,
                               const std::uint8_t* __restrict c, int count, std::uint8_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const auto sides = static_cast<std::uint8_t>((a[i] + c[i] + 1) / 2);
    out[i] = static_cast<std::uint8_t>((sides + b[i]) / 2);
  }
}

/// The differences of a row's pixels to those of another row that lie `dx` further; the greatest where there
/// is none.
void differences_to(const ColourPlanes& colour, int y, int dx, int other_y, Bytes& out) {
  const int width = colour.width();
  std::fill(out.begin(), out.end(), std::uint8_t{255});
  if (other_y < 0 || other_y >= colour.height()) return;
  const int first = std::max(0, -dx);
  colour_differences(colour, first, y, first + dx, other_y, std::min(width, width - dx) - first,
                     out.data() + first);
}

/// Matches one stripe of the picture. All of its rows' costs and sums are kept until the paths from below
/// have come up.
class StripeMatcher {
 public:
  StripeMatcher(const MatchingCost& costs, int disparities, int stride, int begin, int end)
      : costs_(costs),
        colour_(costs.left_colour()),
        width_(colour_.width()),
        height_(colour_.height()),
        disparities_(disparities),
        stride_(stride),
        begin_(begin),
        end_(end),
        first_(std::max(0, begin - kLeadIn)),
        last_(std::min(height_, end + kLeadIn)),
        row_size_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(stride)),
        cost_(std::make_unique_for_overwrite<std::uint8_t[]>(row_size_ * rows(last_ - first_))),
        scratch_(row_size_),
        sum_(std::make_unique_for_overwrite<std::uint16_t[]>(row_size_ * rows(end - begin))),
        beyond_(row_size_),
        steps_(static_cast<std::size_t>(last_ - first_), RowSteps(width_)),
        difference_(static_cast<std::size_t>(width_)),
        difference_too_(difference_),
        steps_from_left_(difference_),
        right_least_(static_cast<std::size_t>(width_ + stride)),
        right_best_(right_least_) {
    for (Bytes& row : ring_) row.resize(row_size_);
    for (std::size_t i = 0; i < step_.size(); ++i)
      step_[i] = static_cast<std::uint8_t>(std::lround(
          std::max(kLeastLargeStep, kLargeStep * std::exp(-static_cast<float>(i) / kLikeColour))));
  }

  void run(Raster<float>& left_px, Raster<float>& right_px) {
    int next = std::max(0, first_ - kReach);
    RowPaths row_paths(stride_);
    ColumnPaths down(width_, stride_);
    for (int y = first_; y < last_; ++y) {
      while (next <= std::min(y + kReach, height_ - 1)) add_row(next++);
      smooth_columns(y);
      fill_steps(y);
      if (y >= end_) continue;
      down.add(cost_of(y), steps_of(y), SumState::begins, sum_of(y));
      if (y < begin_) continue;
      differences_to(colour_, y, -1, y, difference_);
      to_steps(steps_from_left_);
      row_paths.add(cost_of(y), steps_from_left_, sum_of(y));
    }
    ColumnPaths up(width_, stride_);
    for (int y = last_ - 1; y >= begin_; --y) {
      up.add(cost_of(y), seen_from_below(y), SumState::goes_on, sum_of(y));
      if (y < end_) choose(y, left_px.row(y), right_px.row(y));
    }
  }

 private:
  static std::size_t rows(int count) { return static_cast<std::size_t>(count); }
  std::uint8_t* cost_of(int y) { return cost_.get() + row_size_ * static_cast<std::size_t>(y - first_); }
  /// What is summed outside the stripe is of no use.
  std::uint16_t* sum_of(int y) {
    return y >= begin_ && y < end_ ? sum_.get() + row_size_ * static_cast<std::size_t>(y - begin_)
                                   : beyond_.data();
  }
  RowSteps& steps_of(int y) { return steps_[static_cast<std::size_t>(y - first_)]; }
  Bytes& ring(int y) { return ring_[static_cast<std::size_t>(y % kRing)]; }
  std::size_t at(int x) const { return static_cast<std::size_t>(x) * static_cast<std::size_t>(stride_); }

  /// Costs of row y, averaged along the row.
  void add_row(int y) {
    Bytes& out = ring(y);
    costs_.fill_row(y, stride_, out.data());
    for (int pass = 0; pass < kColumnPasses; ++pass) {
      const int reach = 1 << pass;
      differences_to(colour_, y, -reach, y, difference_);
      differences_to(colour_, y, reach, y, difference_too_);
      for (int x = 0; x < width_; ++x) {
        const auto i = static_cast<std::size_t>(x);
        smooth(out.data() + at(difference_[i] < kAlike ? x - reach : x), out.data() + at(x),
               out.data() + at(difference_too_[i] < kAlike ? x + reach : x), stride_,
               scratch_.data() + at(x));
      }
      out.swap(scratch_);
    }
  }

  /// Sets the costs of row y from those in the ring, averaged along the columns.
  void smooth_columns(int y) {
    const std::uint8_t* from = ring(y).data();
    std::uint8_t* to = kRowPasses % 2 == 0 ? scratch_.data() : cost_of(y);
    std::uint8_t* other = kRowPasses % 2 == 0 ? cost_of(y) : scratch_.data();
    for (int pass = 0; pass < kRowPasses; ++pass) {
      const int reach = 1 << pass;
      differences_to(colour_, y, 0, y - reach, difference_);
      differences_to(colour_, y, 0, y + reach, difference_too_);
      for (int x = 0; x < width_; ++x) {
        const auto i = static_cast<std::size_t>(x);
        smooth((difference_[i] < kAlike ? ring(y - reach).data() : from) + at(x), from + at(x),
               (difference_too_[i] < kAlike ? ring(y + reach).data() : from) + at(x), stride_, to + at(x));
      }
      from = to;
      std::swap(to, other);
    }
  }

  void to_steps(Bytes& steps) const {
    for (std::size_t x = 0; x < steps.size(); ++x) steps[x] = step_[difference_[x]];
  }
  /// The steps from the row above to row y.
  void fill_steps(int y) {
    RowSteps& steps = steps_of(y);
    differences_to(colour_, y, -1, y - 1, difference_);
    to_steps(steps.before_left);
    differences_to(colour_, y, 0, y - 1, difference_);
    to_steps(steps.before);
    differences_to(colour_, y, 1, y - 1, difference_);
    to_steps(steps.before_right);
  }
  /// The steps from the row below to row y: those that lead down there, the other way.
  RowSteps seen_from_below(int y) {
    if (y + 1 == last_) return RowSteps(width_);
    const RowSteps& down = steps_of(y + 1);
    RowSteps up = down;
    std::copy(down.before_right.begin(), down.before_right.end() - 1, up.before_left.begin() + 1);
    std::copy(down.before_left.begin() + 1, down.before_left.end(), up.before_right.begin());
    return up;
  }

  void choose(int y, std::span<float> left_px, std::span<float> right_px) {
    std::fill(right_least_.begin(), right_least_.end(), std::uint16_t{65535});
    for (int x = 0; x < width_; ++x) {
      const std::uint16_t* sum = sum_of(y) + at(x);
      const auto there = static_cast<std::size_t>(width_ - 1 - x);
      keep_least(sum, static_cast<std::uint16_t>(x), std::min(disparities_, x + 1),
                 right_least_.data() + there, right_best_.data() + there);
      const int d = least_at(sum, disparities_);
      left_px[static_cast<std::size_t>(x)] = static_cast<float>(d) + sub_pixel_offset(sum, d, disparities_);
    }
    for (int x = 0; x < width_; ++x)
      right_px[static_cast<std::size_t>(x)] =
          static_cast<float>(right_best_[static_cast<std::size_t>(width_ - 1 - x)] - x);
  }

  const MatchingCost& costs_;
  const ColourPlanes& colour_;
  int width_, height_, disparities_, stride_;
  /// The stripe's rows, and with those that lead in.
  int begin_, end_, first_, last_;
  std::size_t row_size_;
  std::array<std::uint8_t, 256> step_{};  // by colour difference
  std::array<Bytes, kRing> ring_;
  std::unique_ptr<std::uint8_t[]> cost_;  // large, and all of it is overwritten first
  Bytes scratch_;
  std::unique_ptr<std::uint16_t[]> sum_;
  std::vector<std::uint16_t> beyond_;
  std::vector<RowSteps> steps_;
  Bytes difference_, difference_too_, steps_from_left_;
  std::vector<std::uint16_t> right_least_, right_best_;
};

}  // namespace

Result<MatchOutput> match_fast(const MatchInput& input, const StereoOptions&, const Work& work) {
  const int w = input.left.width();
  const int h = input.left.height();
  const int stride = whole_vectors(input.disparities);
  const MatchingCost costs(input, kCost, work);
  MatchOutput out{Raster<float>(w, h), {}};
  Raster<float> right_px(w, h);
  const int stripes = 2 * ((h + kTwoStripes - 1) / kTwoStripes);
  const auto row = [&](int stripe) { return h * stripe / stripes; };
  parallel_for(work, stripes, 1, [&](int begin, int end) {
    for (int stripe = begin; stripe < end && !work.cancelled(); ++stripe)
      StripeMatcher(costs, input.disparities, stride, row(stripe), row(stripe + 1))
          .run(out.disparity_px, right_px);
  });
  if (work.cancelled()) return Work::interrupted();

  hide_before(input.right_first, right_px);
  out.confidence = agreement(out.disparity_px, right_px);
  Raster<std::uint8_t> trusted(w, h);
  for (std::size_t i = 0; i < trusted.count(); ++i) trusted.values()[i] = out.confidence.values()[i] > 0.0F;
  fill_from_behind(trusted, out.disparity_px);
  // Twice: specks of a few pixels go too, and corners stay sharper than under one wide median.
  for (int pass = 0; pass < 2; ++pass) out.disparity_px = median_3x3(out.disparity_px, work);
  return out;
}

}  // namespace palpable::vision
