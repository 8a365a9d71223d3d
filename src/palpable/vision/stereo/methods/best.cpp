// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/best.hpp"

#include "palpable/vision/image/median.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

/// All that is known of one view; the right one is kept mirrored, so that both are matched alike.
struct View {
  MatchView picture;
  Regions regions;
  CostVolume costs;
  PlaneMap start;
  PlaneMap map;
};

/// Its costs and first disparities.
void start_view(View& view, const MatchView& there, const BestOptions& options, CostVolume& scratch,
                const Work& work) {
  pixel_costs(view.picture, there, options.volume, view.costs, work);
  average_over_crosses(view.picture.colour, options.volume.cross, view.costs, scratch, work);
  aggregate_paths(view.costs, view.picture.colour, there.colour, options.sgm, scratch, work);
  view.start = PlaneMap(view.costs.width, view.costs.height);
  view.start.disparity = least_cost_disparity(scratch, work);
  view.map = view.start;
}

/// The right view's disparities in its own frame; columns that the picture does not show count as infinitely
/// near.
Raster<float> seen_from_right(const View& right, int first) {
  Raster<float> out = mirrored(right.map.disparity);
  mask_columns_before(first, out);
  return out;
}

/// Confidence of a pixel: how well its colours agree at the match, and how closely the two views do.
Raster<float> confidence(const View& view, const Raster<float>& other, const BestOptions& options,
                         const Work& work) {
  Raster<float> out(other.width(), other.height());
  parallel_for(work, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < out.width(); ++x) {
        const float d = view.map.disparity(x, y);
        const int there = static_cast<int>(std::floor(static_cast<float>(x) - d + 0.5F));
        if (there < 0 || there >= out.width()) {
          out(x, y) = options.least_confidence;
          continue;
        }
        const float gap = (other(there, y) - d) / options.half_confidence_px;
        const int nearest = std::clamp(static_cast<int>(d + 0.5F), 0, view.costs.disparities - 1);
        const float cost =
            static_cast<float>(view.costs.at(x, y)[nearest]) / (options.half_confidence_cost * kCostUnit);
        out(x, y) = std::max(options.least_confidence, 1.0F / ((1.0F + gap * gap) * (1.0F + cost * cost)));
      }
  });
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(BestOptions& o) {
  std::vector<Parameter> all{
      {"separate_rounds",
       &o.separate_rounds,
       {1, 20},
       "",
       "Rounds of the plane search of each view by itself"},
      {"joint_rounds", &o.joint_rounds, {0, 20}, "", "Rounds of both views with what the other sees"},
      {"last_rounds", &o.last_rounds, {0, 20}, "", "Last rounds of the left view"},
      {"first_exchange",
       &o.first_exchange,
       {0, 60},
       "",
       "First round with the other view's planes as candidates"},
      {"region_complexity", &o.region_complexity, {1, 1024}, "", "Q of statistical region merging"},
      {"furthest_fraction", &o.furthest_fraction, {0, 0.5}, "", "Furthest pixels left out of the seen range"},
      {"furthest_margin_px",
       &o.furthest_margin_px,
       {0, 100},
       "px",
       "Hidden surfaces lie at most so far behind it"},
      {"half_confidence_cost",
       &o.half_confidence_cost,
       {0.01, 4},
       "units",
       "Cost at which confidence is half"},
      {"half_confidence_px",
       &o.half_confidence_px,
       {0.01, 10},
       "px",
       "Difference of the views at which it is half"},
      {"least_confidence", &o.least_confidence, {0, 1}, "", "Confidence out of view"}};
  append_parameters(all, "volume", parameters_of(o.volume));
  append_parameters(all, "sgm", parameters_of(o.sgm));
  append_parameters(all, "proposals", parameters_of(o.proposals));
  append_parameters(all, "costs", parameters_of(o.costs));
  append_parameters(all, "smoothness", parameters_of(o.smoothness));
  append_parameters(all, "islands", parameters_of(o.islands));
  append_parameters(all, "shift", parameters_of(o.shift));
  append_parameters(all, "background", parameters_of(o.background));
  append_parameters(all, "contradicted", parameters_of(o.contradicted));
  return all;
}

Result<void> check(const BestOptions& options) { return check_ranges(options); }

Result<MatchOutput> match_best(const MatchInput& input, const BestOptions& options, const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  const int w = input.left.width();
  const int h = input.left.height();
  View left;
  View right;
  left.picture = match_view(input.left, input.left_grey, options.volume.census, work);
  right.picture = match_view(mirrored(input.right), mirrored(input.right_grey), options.volume.census, work);
  parallel_for(work, 2, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      if (k == 0) left.regions = merge_regions(input.left, options.region_complexity);
      if (k == 1) right.regions = merge_regions(mirrored(input.right), options.region_complexity);
    }
  });
  left.costs = right.costs = CostVolume(w, h, input.disparities);
  const Raster<float> everything(w, h, 1.0F);
  {
    CostVolume scratch(w, h, input.disparities);
    MatchView there = match_view(input.right, input.right_grey, options.volume.census, work);
    there.first = input.right_first;
    start_view(left, there, options, scratch, work);
    if (work.cancelled()) return Work::interrupted();
    work.report(0.1, "matching");
    start_view(right,
               match_view(mirrored(input.left), mirrored(input.left_grey), options.volume.census, work),
               options, scratch, work);
    work.report(0.2, "matching");
  }

  OtherView unknown;
  unknown.first = input.right_first;
  PlaneCandidates candidates(w, h);
  int round = 0;
  const auto search = [&](View& view, const OtherView& other, const Raster<float>& trust) {
    const bool exchange = round >= options.first_exchange;
    PlaneMap theirs;
    if (exchange)
      theirs = planes_in_other_view(&view == &left ? right.map : left.map, options.proposals.fit, work);
    propose_planes(view.picture.colour,
                   {view.map, view.start, trust, view.regions, exchange ? &theirs : nullptr},
                   options.proposals, round, candidates, work);
    plane_costs(view.costs, other, options.costs, candidates, work);
    choose_planes(view.picture.colour, options.smoothness, candidates, view.map, work);
  };
  const int rounds = options.separate_rounds + options.joint_rounds + options.last_rounds;
  for (; round < options.separate_rounds; ++round) {
    search(left, unknown, everything);
    if (work.cancelled()) return Work::interrupted();
    search(right, {}, everything);
    if (work.cancelled()) return Work::interrupted();
    work.report(0.2 + 0.8 * (round + 1) / rounds, "finding surfaces");
  }
  float furthest = 0.0F;
  for (; round < rounds; ++round) {
    for (View* view : {&left, &right})
      remove_false_islands(view->costs, options.islands, options.costs, view->map, view->start);
    const Raster<float> seen_right = seen_from_right(right, input.right_first);
    const Raster<float> seen_left = mirrored(left.map.disparity);
    const Raster<float> agreed = left_right_check(left.map.disparity, seen_right);
    if (round == options.separate_rounds)
      furthest =
          quantile_where(left.map.disparity, agreed, options.furthest_fraction) - options.furthest_margin_px;
    if (work.cancelled()) return Work::interrupted();
    const Raster<float> agreed_right = left_right_check(right.map.disparity, seen_left);
    search(left, {&seen_right, furthest}, agreed);
    if (work.cancelled()) return Work::interrupted();
    if (round < options.separate_rounds + options.joint_rounds)
      search(right, {&seen_left, furthest}, agreed_right);
    work.report(0.2 + 0.8 * (round + 1) / rounds, "finding what is hidden");
  }

  MatchOutput out;
  const Raster<float> seen_right = seen_from_right(right, input.right_first);
  out.confidence = confidence(left, seen_right, options, work);
  shift_between_pixels(left.picture.colour, input.left_grey, input.right_grey, seen_right, options.shift,
                       left.map, work);
  if (work.cancelled()) return Work::interrupted();
  continue_background(left.picture.colour, seen_right, options.background, left.map, work);
  out.disparity_px = median_3x3(
      replace_contradicted(left.picture.colour, seen_right, options.contradicted, left.map, work), work);
  return out;
}

}  // namespace palpable::vision
