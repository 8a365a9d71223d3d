// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/fast.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/median.hpp"
#include "palpable/vision/stereo/cost/least_cost.hpp"
#include "palpable/vision/stereo/cost/path_costs.hpp"
#include "palpable/vision/stereo/cost/sub_pixel.hpp"
#include "palpable/vision/stereo/occlusion/filling.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string>

namespace palpable::vision {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// (a + 2 b + c) / 4, rounded up and down.
PALPABLE_VECTORIZE void smooth(const std::uint8_t* __restrict a, const std::uint8_t* __restrict b,
                               const std::uint8_t* __restrict c, int count, std::uint8_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const auto sides = static_cast<std::uint8_t>((a[i] + c[i] + 1) / 2);
    out[i] = static_cast<std::uint8_t>((sides + b[i]) / 2);
  }
}

/// The differences of a row's pixels to those of another row, shifted by `dx`; the maximum outside the
/// picture.
void differences_to(const ColourPlanes& colour, int y, int dx, int other_y, Bytes& out) {
  const int width = colour.width();
  std::fill(out.begin(), out.end(), std::uint8_t{255});
  if (other_y < 0 || other_y >= colour.height()) return;
  const int first = std::max(0, -dx);
  colour_differences(colour, first, y, first + dx, other_y, std::min(width, width - dx) - first,
                     out.data() + first);
}

/// Matches one stripe of the picture. The costs and sums of all its rows are kept until the upward paths are
/// done.
class StripeMatcher {
 public:
  StripeMatcher(const MatchingCost& costs, const FastOptions& options, int disparities, int stride, int begin,
                int end)
      : options_(options),
        reach_(1 << (options.column_passes - 1)),
        costs_(costs),
        colour_(costs.left_colour()),
        width_(colour_.width()),
        height_(colour_.height()),
        disparities_(disparities),
        stride_(stride),
        begin_(begin),
        end_(end),
        first_(std::max(0, begin - options.lead_in_rows)),
        last_(std::min(height_, end + options.lead_in_rows)),
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
    ring_.assign(static_cast<std::size_t>(2 * reach_ + 1), Bytes(row_size_));
    for (std::size_t i = 0; i < step_.size(); ++i)
      step_[i] = static_cast<std::uint8_t>(std::lround(
          std::max(options.least_large_step,
                   options.large_step * std::exp(-static_cast<float>(i) / options.step_colour_levels))));
  }

  void run(Raster<float>& left_px, Raster<float>& right_px) {
    int next = std::max(0, first_ - reach_);
    RowPaths row_paths(stride_, options_.small_step_share);
    ColumnPaths down(width_, stride_, options_.small_step_share);
    for (int y = first_; y < last_; ++y) {
      while (next <= std::min(y + reach_, height_ - 1)) add_row(next++);
      smooth_columns(y);
      fill_steps(y);
      if (y >= end_) continue;
      down.add(cost_of(y), steps_of(y), SumState::begins, sum_of(y));
      if (y < begin_) continue;
      differences_to(colour_, y, -1, y, difference_);
      to_steps(steps_from_left_);
      row_paths.add(cost_of(y), steps_from_left_, sum_of(y));
    }
    ColumnPaths up(width_, stride_, options_.small_step_share);
    for (int y = last_ - 1; y >= begin_; --y) {
      up.add(cost_of(y), seen_from_below(y), SumState::continues, sum_of(y));
      if (y < end_) choose(y, left_px.row(y), right_px.row(y));
    }
  }

 private:
  static std::size_t rows(int count) { return static_cast<std::size_t>(count); }
  std::uint8_t* cost_of(int y) { return cost_.get() + row_size_ * static_cast<std::size_t>(y - first_); }
  /// Sums outside the stripe are discarded.
  std::uint16_t* sum_of(int y) {
    return y >= begin_ && y < end_ ? sum_.get() + row_size_ * static_cast<std::size_t>(y - begin_)
                                   : beyond_.data();
  }
  RowSteps& steps_of(int y) { return steps_[static_cast<std::size_t>(y - first_)]; }
  Bytes& ring(int y) { return ring_[static_cast<std::size_t>(y) % ring_.size()]; }
  std::size_t at(int x) const { return static_cast<std::size_t>(x) * static_cast<std::size_t>(stride_); }

  /// Costs of row y, averaged along the row.
  void add_row(int y) {
    Bytes& out = ring(y);
    costs_.fill_row(y, stride_, out.data());
    for (int pass = 0; pass < options_.row_passes; ++pass) {
      const int reach = 1 << pass;
      differences_to(colour_, y, -reach, y, difference_);
      differences_to(colour_, y, reach, y, difference_too_);
      for (int x = 0; x < width_; ++x) {
        const auto i = static_cast<std::size_t>(x);
        smooth(out.data() + at(difference_[i] < options_.similar_levels ? x - reach : x), out.data() + at(x),
               out.data() + at(difference_too_[i] < options_.similar_levels ? x + reach : x), stride_,
               scratch_.data() + at(x));
      }
      out.swap(scratch_);
    }
  }

  /// Sets the costs of row y from those in the ring, averaged along the columns.
  void smooth_columns(int y) {
    const std::uint8_t* from = ring(y).data();
    std::uint8_t* to = options_.column_passes % 2 == 0 ? scratch_.data() : cost_of(y);
    std::uint8_t* other = options_.column_passes % 2 == 0 ? cost_of(y) : scratch_.data();
    for (int pass = 0; pass < options_.column_passes; ++pass) {
      const int reach = 1 << pass;
      differences_to(colour_, y, 0, y - reach, difference_);
      differences_to(colour_, y, 0, y + reach, difference_too_);
      for (int x = 0; x < width_; ++x) {
        const auto i = static_cast<std::size_t>(x);
        smooth((difference_[i] < options_.similar_levels ? ring(y - reach).data() : from) + at(x),
               from + at(x),
               (difference_too_[i] < options_.similar_levels ? ring(y + reach).data() : from) + at(x),
               stride_, to + at(x));
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
  /// The steps from the row below to row y: those of the downward paths, reversed.
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

  const FastOptions& options_;
  int reach_;  // of the averages along the column
  const MatchingCost& costs_;
  const ColourPlanes& colour_;
  int width_, height_, disparities_, stride_;
  /// The stripe's rows, without and with the lead-in rows.
  int begin_, end_, first_, last_;
  std::size_t row_size_;
  std::array<std::uint8_t, 256> step_{};  // by colour difference
  std::vector<Bytes> ring_;
  std::unique_ptr<std::uint8_t[]> cost_;  // large, and all of it is overwritten first
  Bytes scratch_;
  std::unique_ptr<std::uint16_t[]> sum_;
  std::vector<std::uint16_t> beyond_;
  std::vector<RowSteps> steps_;
  Bytes difference_, difference_too_, steps_from_left_;
  std::vector<std::uint16_t> right_least_, right_best_;
};

}  // namespace

std::vector<Parameter> parameters_of(FastOptions& o) {
  std::vector<Parameter> all{
      {"row_passes", &o.row_passes, {0, 5}, "", "Passes of averaging along the row"},
      {"column_passes", &o.column_passes, {1, 4}, "", "Passes of averaging along the column"},
      {"similar_levels",
       &o.similar_levels,
       {1, 255},
       "levels",
       "Neighbours that differ by less are averaged"},
      {"large_step",
       &o.large_step,
       {1, kLargestStep},
       "cost",
       "Penalty of a step of more than one disparity"},
      {"step_colour_levels",
       &o.step_colour_levels,
       {1, 255},
       "levels",
       "Colour difference at which it falls by e"},
      {"least_large_step", &o.least_large_step, {0, kLargestStep}, "cost", "Its least value"},
      {"small_step_share",
       &o.small_step_share,
       {0, 256},
       "1/256",
       "Penalty of a step of one disparity beside it"},
      {"stripe_rows", &o.stripe_rows, {16, 4096}, "px", "Most rows of a stripe"},
      {"lead_in_rows", &o.lead_in_rows, {0, 200}, "px", "Rows beside a stripe at which its paths begin"},
      {"medians", &o.medians, {0, 10}, "", "3 x 3 medians at the end"}};
  append_parameters(all, "cost", parameters_of(o.cost));
  append_parameters(all, "steps", parameters_of(o.steps));
  append_parameters(all, "plain_steps", parameters_of(o.plain_steps));
  return all;
}

Result<void> check(const FastOptions& options) {
  if (auto ok = check_ranges(options); !ok) return ok;
  const CostOptions& cost = options.cost;
  const int most = (63 * cost.census_weight + cost.colour_limit * cost.colour_weight) >> cost.halvings;
  if (most <= kLargestCost) return {};
  return Error{
      ErrorCode::usage,
      "the largest cost would be " + std::to_string(most) + ", more than " + std::to_string(kLargestCost),
      "cost"};
}

Result<MatchOutput> match_fast(const MatchInput& input, const FastOptions& options, const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  const int w = input.left.width();
  const int h = input.left.height();
  const int stride = whole_vectors(input.disparities);
  const MatchingCost costs(input, options.cost, work);
  MatchOutput out{Raster<float>(w, h), {}};
  Raster<float> right_px(w, h);
  const int two_stripes = 2 * options.stripe_rows;
  const int stripes = 2 * ((h + two_stripes - 1) / two_stripes);
  const auto row = [&](int stripe) { return h * stripe / stripes; };
  parallel_for(work, stripes, 1, [&](int begin, int end) {
    for (int stripe = begin; stripe < end && !work.cancelled(); ++stripe)
      StripeMatcher(costs, options, input.disparities, stride, row(stripe), row(stripe + 1))
          .run(out.disparity_px, right_px);
  });
  if (work.cancelled()) return Work::interrupted();

  mask_columns_before(input.right_first, right_px);
  out.confirmed = left_right_check(out.disparity_px, right_px);
  Raster<std::uint8_t> trusted(w, h);
  for (std::size_t i = 0; i < trusted.count(); ++i) trusted.values()[i] = out.confirmed.values()[i] > 0.0F;
  fill_from_background(trusted, out.disparity_px);
  for (int pass = 0; pass < options.medians; ++pass) out.disparity_px = median_3x3(out.disparity_px, work);
  median_at_steps(costs.left_colour(), options.steps, out.disparity_px, work);
  move_steps_in_plain_surfaces(costs.left_colour(), options.plain_steps, out.disparity_px, work);
  if (work.cancelled()) return Work::interrupted();
  return out;
}

}  // namespace palpable::vision
