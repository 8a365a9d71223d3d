// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/best.hpp"

#include "palpable/core/numbers/median.hpp"
#include "palpable/vision/image/median.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

/// The state of one view; the right one is mirrored, so that both are matched by the same code.
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

/// The right view's disparities in its own frame; infinite in columns outside the picture.
Raster<float> seen_from_right(const View& right, int first) {
  Raster<float> out = mirrored(right.map.disparity);
  mask_columns_before(first, out);
  return out;
}

/// The search over both views, round by round.
class BestMatcher {
 public:
  BestMatcher(const MatchInput& input, const BestOptions& options, const Work& work)
      : input_(input), options_(options), work_(work) {}

  /// Costs and first disparities of both views.
  void start() {
    const int w = input_.left.width(), h = input_.left.height();
    left_.picture = match_view(input_.left, input_.left_grey, options_.volume.census, work_);
    right_.picture =
        match_view(mirrored(input_.right), mirrored(input_.right_grey), options_.volume.census, work_);
    parallel_for(work_, 2, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        if (k == 0) left_.regions = merge_regions(input_.left, options_.region_complexity);
        if (k == 1) right_.regions = merge_regions(mirrored(input_.right), options_.region_complexity);
      }
    });
    left_.costs = right_.costs = CostVolume(w, h, input_.disparities);
    {
      CostVolume scratch(w, h, input_.disparities);
      MatchView there = match_view(input_.right, input_.right_grey, options_.volume.census, work_);
      there.first = input_.right_first;
      start_view(left_, there, options_, scratch, work_);
      if (work_.cancelled()) return;
      work_.report(0.1, "matching");
      start_view(right_,
                 match_view(mirrored(input_.left), mirrored(input_.left_grey), options_.volume.census, work_),
                 options_, scratch, work_);
      work_.report(0.2, "matching");
    }
    candidates_ = PlaneCandidates(w, h);
  }

  /// A round of each view by itself.
  void separate_round(int round) {
    const Raster<float> everything(input_.left.width(), input_.left.height(), 1.0F);
    OtherView unknown;
    unknown.first = input_.right_first;
    search(left_, right_, unknown, everything, round);
    if (work_.cancelled()) return;
    search(right_, left_, {}, everything, round);
    report(round, "finding surfaces");
  }

  /// A round in which each view's disparities change the other's costs; in the last rounds only the left view
  /// is updated.
  void joint_round(int round) {
    for (View* view : {&left_, &right_})
      remove_false_islands(view->costs, options_.islands, costs_, view->map, view->start);
    const Raster<float> seen_right = seen_from_right(right_, input_.right_first);
    const Raster<float> seen_left = mirrored(left_.map.disparity);
    const Raster<float> confirmed = left_right_check(left_.map.disparity, seen_right);
    if (round == options_.separate_rounds) {
      costs_.hidden_cost =
          std::max(options_.costs.hidden_cost, options_.hidden_above_match + median_match(confirmed));
      furthest_px_ = quantile_where(left_.map.disparity, confirmed, options_.furthest_fraction) -
                     options_.furthest_margin_px;
    }
    if (work_.cancelled()) return;
    const Raster<float> confirmed_right = left_right_check(right_.map.disparity, seen_left);
    search(left_, right_, {&seen_right, furthest_px_}, confirmed, round);
    if (work_.cancelled()) return;
    if (round < options_.separate_rounds + options_.joint_rounds)
      search(right_, left_, {&seen_left, furthest_px_}, confirmed_right, round);
    report(round, "finding occluded surfaces");
  }

  /// The left view's sub-pixel disparities, with occluded and contradicted ones replaced.
  MatchOutput finish() {
    MatchOutput out;
    const Raster<float> seen_right = seen_from_right(right_, input_.right_first);
    out.confirmed = left_right_check(left_.map.disparity, seen_right);
    const ColourPlanes& colour = left_.picture.colour;
    refine_photometrically(colour, input_.left_grey, input_.right_grey, seen_right, options_.shift, left_.map,
                           work_);
    if (work_.cancelled()) return out;
    fill_pits(colour, seen_right, options_.background, options_.contradicted, left_.map, work_);
    continue_background(colour, seen_right, options_.background, left_.map, work_);
    out.disparity_px =
        median_3x3(replace_contradicted(colour, seen_right, options_.contradicted, left_.map, work_), work_);
    return out;
  }

  int rounds() const { return options_.separate_rounds + options_.joint_rounds + options_.last_rounds; }

 private:
  void search(View& view, const View& other_view, const OtherView& other, const Raster<float>& trust,
              int round) {
    const bool exchange = round >= options_.first_exchange;
    PlaneMap theirs;
    if (exchange) theirs = planes_in_other_view(other_view.map, options_.proposals.fit, work_);
    propose_planes(view.picture.colour,
                   {view.map, view.start, trust, view.regions, exchange ? &theirs : nullptr},
                   options_.proposals, round, candidates_, work_);
    const Raster<float> nearer_px =
        nearer_beyond_edges(view.picture.colour, view.map.disparity, options_.edges, work_);
    plane_costs(view.costs, other, costs_, candidates_, work_, &nearer_px);
    choose_planes(view.picture.colour, options_.smoothness, candidates_, view.map, work_);
  }
  /// The median matching cost of the left view's confirmed pixels, in units; 0 if there are none.
  float median_match(const Raster<float>& confirmed) const {
    std::vector<float> costs;
    for (int y = 0; y < confirmed.height(); ++y)
      for (int x = 0; x < confirmed.width(); ++x)
        if (confirmed(x, y) > 0.0F)
          costs.push_back(matching_cost_at(left_.costs, x, y, left_.map.disparity(x, y),
                                           options_.costs.beyond_range_per_px));
    return costs.empty() ? 0.0F : median_of(std::move(costs));
  }
  void report(int round, const char* what) const { work_.report(0.2 + 0.8 * (round + 1) / rounds(), what); }

  const MatchInput& input_;
  const BestOptions& options_;
  const Work& work_;
  View left_, right_;
  PlaneCandidates candidates_{0, 0};
  /// With the cost of occluded pixels in this pair.
  PlaneCostOptions costs_ = options_.costs;
  /// Nothing lies further away than this.
  float furthest_px_ = 0.0F;
};

}  // namespace

std::vector<Parameter> parameters_of(BestOptions& o) {
  std::vector<Parameter> all{
      {"separate_rounds",
       &o.separate_rounds,
       {1, 20},
       "",
       "Rounds of the plane search of each view by itself"},
      {"joint_rounds", &o.joint_rounds, {0, 20}, "", "Rounds of both views with occlusions from each other"},
      {"last_rounds", &o.last_rounds, {0, 20}, "", "Last rounds of the left view"},
      {"first_exchange",
       &o.first_exchange,
       {0, 60},
       "",
       "First round with the other view's planes as candidates"},
      {"region_complexity", &o.region_complexity, {1, 1024}, "", "Q of statistical region merging"},
      {"hidden_above_match",
       &o.hidden_above_match,
       {0, 4},
       "units",
       "What an occluded pixel costs more than the median match, at least"},
      {"furthest_fraction", &o.furthest_fraction, {0, 0.5}, "", "Farthest pixels left out of the seen range"},
      {"furthest_margin_px",
       &o.furthest_margin_px,
       {0, 100},
       "px",
       "Greatest distance of occluded surfaces behind it"}};
  append_parameters(all, "volume", parameters_of(o.volume));
  append_parameters(all, "sgm", parameters_of(o.sgm));
  append_parameters(all, "proposals", parameters_of(o.proposals));
  append_parameters(all, "costs", parameters_of(o.costs));
  append_parameters(all, "smoothness", parameters_of(o.smoothness));
  append_parameters(all, "edges", parameters_of(o.edges));
  append_parameters(all, "islands", parameters_of(o.islands));
  append_parameters(all, "shift", parameters_of(o.shift));
  append_parameters(all, "background", parameters_of(o.background));
  append_parameters(all, "contradicted", parameters_of(o.contradicted));
  return all;
}

Result<void> check(const BestOptions& options) { return check_ranges(options); }

Result<MatchOutput> match_best(const MatchInput& input, const BestOptions& options, const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  BestMatcher matcher(input, options, work);
  matcher.start();
  for (int round = 0; round < matcher.rounds() && !work.cancelled(); ++round) {
    if (round < options.separate_rounds)
      matcher.separate_round(round);
    else
      matcher.joint_round(round);
  }
  if (work.cancelled()) return Work::interrupted();
  MatchOutput out = matcher.finish();
  if (work.cancelled()) return Work::interrupted();
  return out;
}

}  // namespace palpable::vision
