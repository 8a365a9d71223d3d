// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/best.hpp"

#include "palpable/vision/image/median.hpp"
#include "palpable/vision/stereo/cost/sgm.hpp"
#include "palpable/vision/stereo/occlusion/left_right.hpp"
#include "palpable/vision/stereo/planes/islands.hpp"
#include "palpable/vision/stereo/planes/photometric_shift.hpp"
#include "palpable/vision/stereo/planes/plane_search.hpp"
#include "palpable/vision/stereo/planes/plane_votes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace palpable::vision {
namespace {

/// Rounds of the plane search: each view alone, both with what the other sees, and the left one at last.
constexpr int kAloneRounds = 3;
constexpr int kTogetherRounds = 3;
constexpr int kLastRounds = 2;
/// From this round on each view is told the other's planes: before, they are mostly noise.
constexpr int kFirstAcross = 2;
/// Of the regions of like colour, finer than what merge_regions() is used for elsewhere: a region should lie
/// on one surface, or on two.
constexpr double kRegionComplexity = 128.0;
/// The nearest of the far end that a hidden surface may lie at: this fraction of what is seen lies further.
constexpr double kFurthestSeen = 0.005;
constexpr float kFurthestMargin_px = 1.0F;

/// All that is known of one view; the right one is kept mirrored, so that both are matched alike.
struct View {
  MatchView picture;
  Regions regions;
  CostVolume costs;
  PlaneMap start;
  PlaneMap map;
};

void start_view(View& view, const MatchView& there, CostVolume& scratch, const Work& work) {
  pixel_costs(view.picture, there, view.costs, work);
  average_over_crosses(view.picture.colour, view.costs, scratch, work);
  aggregate_paths(view.costs, view.picture.colour, there.colour, scratch, work);
  view.start = PlaneMap(view.costs.width, view.costs.height);
  view.start.disparity = least_cost_disparity(scratch, work);
  view.map = view.start;
}

/// The right view's disparities in its own frame; what that picture does not show hides all behind it.
Raster<float> seen_from_right(const View& right, int first) {
  Raster<float> out = mirrored(right.map.disparity);
  for (int y = 0; y < out.height(); ++y)
    std::fill_n(out.row(y).begin(), first, std::numeric_limits<float>::infinity());
  return out;
}

/// Confidence of a pixel: how well its colours agree at the match, and how closely the two views do.
Raster<float> confidence(const View& view, const Raster<float>& other, const Work& work) {
  constexpr float kHalfCost = 0.5F;
  constexpr float kHalfGap_px = 0.5F;
  constexpr float kUnseen = 0.1F;
  Raster<float> out(other.width(), other.height());
  parallel_for(work, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < out.width(); ++x) {
        const float d = view.map.disparity(x, y);
        const int there = static_cast<int>(std::floor(static_cast<float>(x) - d + 0.5F));
        if (there < 0 || there >= out.width()) {
          out(x, y) = kUnseen;
          continue;
        }
        const float gap = (other(there, y) - d) / kHalfGap_px;
        const int nearest = std::clamp(static_cast<int>(d + 0.5F), 0, view.costs.disparities - 1);
        const float cost = static_cast<float>(view.costs.at(x, y)[nearest]) / (kHalfCost * kCostUnit);
        out(x, y) = std::max(kUnseen, 1.0F / ((1.0F + gap * gap) * (1.0F + cost * cost)));
      }
  });
  return out;
}

}  // namespace

Result<MatchOutput> match_best(const MatchInput& input, const StereoOptions&, const Work& work) {
  const int w = input.left.width();
  const int h = input.left.height();
  View left;
  View right;
  left.picture = match_view(input.left, input.left_grey, work);
  right.picture = match_view(mirrored(input.right), mirrored(input.right_grey), work);
  parallel_for(work, 2, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      if (k == 0) left.regions = merge_regions(input.left, kRegionComplexity);
      if (k == 1) right.regions = merge_regions(mirrored(input.right), kRegionComplexity);
    }
  });
  left.costs = right.costs = CostVolume(w, h, input.disparities);
  const Raster<float> everything(w, h, 1.0F);
  {
    CostVolume scratch(w, h, input.disparities);
    MatchView there = match_view(input.right, input.right_grey, work);
    there.first = input.right_first;
    start_view(left, there, scratch, work);
    if (work.cancelled()) return Work::interrupted();
    work.report(0.1, "matching");
    start_view(right, match_view(mirrored(input.left), mirrored(input.left_grey), work), scratch, work);
    work.report(0.2, "matching");
  }

  OtherView unknown;
  unknown.first = input.right_first;
  PlaneCandidates candidates(w, h);
  int round = 0;
  const auto search = [&](View& view, const OtherView& other, const Raster<float>& trust) {
    PlaneMap across;
    if (round >= kFirstAcross) across = planes_across(&view == &left ? right.map : left.map, work);
    const PlaneMap* told = round >= kFirstAcross ? &across : nullptr;
    propose_planes(view.picture.colour, {view.map, view.start, trust, view.regions, told}, round, candidates,
                   work);
    plane_costs(view.costs, other, candidates, work);
    choose_planes(view.picture.colour, candidates, view.map, work);
  };
  constexpr int kRounds = kAloneRounds + kTogetherRounds + kLastRounds;
  for (; round < kAloneRounds; ++round) {
    search(left, unknown, everything);
    if (work.cancelled()) return Work::interrupted();
    search(right, {}, everything);
    if (work.cancelled()) return Work::interrupted();
    work.report(0.2 + 0.8 * (round + 1) / kRounds, "finding surfaces");
  }
  float furthest = 0.0F;
  for (; round < kRounds; ++round) {
    for (View* view : {&left, &right}) remove_feigned_islands(view->costs, view->map, view->start);
    const Raster<float> seen_right = seen_from_right(right, input.right_first);
    const Raster<float> seen_left = mirrored(left.map.disparity);
    const Raster<float> agreed = agreement(left.map.disparity, seen_right);
    if (round == kAloneRounds)
      furthest = quantile_where(left.map.disparity, agreed, kFurthestSeen) - kFurthestMargin_px;
    if (work.cancelled()) return Work::interrupted();
    const Raster<float> agreed_right = agreement(right.map.disparity, seen_left);
    search(left, {&seen_right, furthest}, agreed);
    if (work.cancelled()) return Work::interrupted();
    if (round < kAloneRounds + kTogetherRounds) search(right, {&seen_left, furthest}, agreed_right);
    work.report(0.2 + 0.8 * (round + 1) / kRounds, "finding what is hidden");
  }

  MatchOutput out;
  const Raster<float> seen_right = seen_from_right(right, input.right_first);
  out.confidence = confidence(left, seen_right, work);
  shift_between_pixels(left.picture.colour, input.left_grey, input.right_grey, seen_right, left.map, work);
  if (work.cancelled()) return Work::interrupted();
  carry_behind(left.picture.colour, seen_right, left.map, work);
  out.disparity_px = median_3x3(settled(left.picture.colour, seen_right, left.map, work), work);
  return out;
}

}  // namespace palpable::vision
