// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/segments.hpp"

#include "palpable/vision/image/median.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <algorithm>
#include <array>
#include <utility>

// Hong & Chen 2004 as Gomez 2012 describes it (segment_planes), for each of the two pictures; then borders
// are refined pixel by pixel (docs/stereo.md).
namespace palpable::vision {
namespace {

/// The state of one view; the right one is mirrored, so that both are matched by the same code.
struct View {
  MatchInput input;
  MatchView picture;
  CostVolume costs;
  SegmentPlanes surfaces;
  PlaneMap map;
};

MatchInput mirrored_pair(const MatchInput& input) {
  return {mirrored(input.right),     mirrored(input.left), mirrored(input.right_grey),
          mirrored(input.left_grey), input.disparities,    0};
}

/// The planes of both views, one view per thread.
Result<void> find_planes(std::array<View, 2>& views, const SegmentPlaneOptions& options, const Work& work) {
  std::array<Result<void>, 2> done;
  Work each = work;
  each.threads = std::max(1U, work.thread_count() / 2);
  each.progress = {};
  parallel_for(work, 2, 1, [&](int begin, int end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      Result<SegmentPlanes> found = find_segment_planes(views[k].input, options, each);
      if (found)
        views[k].surfaces = std::move(*found);
      else
        done[k] = found.error();
    }
  });
  return done[0] ? done[1] : done[0];
}

/// The plane of each pixel's segment.
PlaneMap map_of(const SegmentPlanes& surfaces) {
  PlaneMap map(surfaces.segments.of_pixel.width(), surfaces.segments.of_pixel.height());
  for (int y = 0; y < map.disparity.height(); ++y)
    for (int x = 0; x < map.disparity.width(); ++x) {
      const SegmentPlane& plane = surfaces.at(x, y);
      map.disparity(x, y) = static_cast<float>(plane.at(x, y));
      map.slope_x(x, y) = static_cast<float>(plane.slope_x);
      map.slope_y(x, y) = static_cast<float>(plane.slope_y);
    }
  return map;
}

/// Candidate planes: those of the segments around a pixel, its own first.
void propose_planes(const SegmentPlanes& surfaces, PlaneCandidates& out, const Work& work) {
  constexpr std::array<std::array<int, 2>, PlaneCandidates::kCount> kAround{{{0, 0},
                                                                             {-3, 0},
                                                                             {3, 0},
                                                                             {0, -3},
                                                                             {0, 3},
                                                                             {-3, -3},
                                                                             {3, 3},
                                                                             {-3, 3},
                                                                             {3, -3},
                                                                             {-8, 0},
                                                                             {8, 0},
                                                                             {0, -8},
                                                                             {0, 8},
                                                                             {-16, 0},
                                                                             {16, 0},
                                                                             {0, 16}}};
  parallel_for(work, out.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < out.width; ++x) {
        std::size_t k = out.at(x, y);
        for (const auto [dx, dy] : kAround) {
          const SegmentPlane& plane =
              surfaces.at(std::clamp(x + dx, 0, out.width - 1), std::clamp(y + dy, 0, out.height - 1));
          out.disparity[k] = static_cast<float>(plane.at(x, y));
          out.slope_x[k] = static_cast<float>(plane.slope_x);
          out.slope_y[k] = static_cast<float>(plane.slope_y);
          ++k;
        }
      }
  });
}

/// The other view's disparities in its own frame; infinite in the columns before `first`, which are outside
/// its picture.
Raster<float> seen_from_other(const View& other, int first) {
  Raster<float> out = mirrored(other.map.disparity);
  mask_columns_before(first, out);
  return out;
}

/// The borders of colour segments and surfaces may differ slightly, so each pixel is reassigned among the
/// planes of nearby segments, with the occlusions from the other view.
void refine_borders(std::array<View, 2>& views, const SegmentsOptions& options, int right_first,
                    const Work& work) {
  const MatchInput& input = views[0].input;
  const int w = input.left.width();
  const int h = input.left.height();
  {
    CostVolume scratch(w, h, input.disparities);
    for (View& view : views) {
      view.picture = match_view(view.input.left, view.input.left_grey, options.volume.census, work);
      view.costs = CostVolume(w, h, input.disparities);
      MatchView there = match_view(view.input.right, view.input.right_grey, options.volume.census, work);
      there.first = view.input.right_first;
      pixel_costs(view.picture, there, options.volume, view.costs, work);
      average_over_crosses(view.picture.colour, options.volume.cross, view.costs, scratch, work);
      view.map = map_of(view.surfaces);
    }
  }
  PlaneCandidates candidates(w, h);
  for (int round = 0; round < options.border_rounds; ++round)
    for (std::size_t k = 0; k < views.size() && !work.cancelled(); ++k) {
      View& view = views[k];
      const Raster<float> seen = seen_from_other(views[1 - k], k == 0 ? right_first : 0);
      propose_planes(view.surfaces, candidates, work);
      const Raster<float> nearer_px =
          nearer_beyond_edges(view.picture.colour, view.map.disparity, options.edges, work);
      plane_costs(view.costs, {&seen, 0.0F}, options.costs, candidates, work, &nearer_px);
      for (std::size_t own = 0; own < candidates.cost.size(); own += PlaneCandidates::kCount)
        candidates.cost[own] -= options.leave_cost;
      choose_planes(view.picture.colour, options.smoothness, candidates, view.map, work);
    }
}

}  // namespace

std::vector<Parameter> parameters_of(SegmentsOptions& o) {
  std::vector<Parameter> all{
      {"border_rounds", &o.border_rounds, {0, 20}, "", "Rounds in which pixels choose among nearby planes"},
      {"leave_cost", &o.leave_cost, {0, 4}, "units", "What it costs a pixel to leave its segment's plane"}};
  append_parameters(all, "planes", parameters_of(o.planes));
  append_parameters(all, "volume", parameters_of(o.volume));
  append_parameters(all, "costs", parameters_of(o.costs));
  append_parameters(all, "smoothness", parameters_of(o.smoothness));
  append_parameters(all, "edges", parameters_of(o.edges));
  append_parameters(all, "background", parameters_of(o.background));
  append_parameters(all, "contradicted", parameters_of(o.contradicted));
  return all;
}

Result<void> check(const SegmentsOptions& options) {
  if (auto ok = check_ranges(options); !ok) return ok;
  if (auto ok = check_window_size(options.planes.scanlines.window); !ok) return ok;
  return check_window_size(options.planes.data.window);
}

Result<MatchOutput> match_segments(const MatchInput& input, const SegmentsOptions& options,
                                   const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  std::array<View, 2> views;
  views[0].input = input;
  views[1].input = mirrored_pair(input);
  work.report(0.05, "segmenting the pictures");
  if (const Result<void> found = find_planes(views, options.planes, work); !found) return found.error();
  work.report(0.5, "refining borders");
  refine_borders(views, options, input.right_first, work);
  if (work.cancelled()) return Work::interrupted();
  View& left = views[0];
  const Raster<float> seen_right = seen_from_other(views[1], input.right_first);
  Raster<float> confirmed = left_right_check(left.map.disparity, seen_right);
  continue_background(left.picture.colour, seen_right, options.background, left.map, work);
  Raster<float> disparity_px =
      replace_contradicted(left.picture.colour, seen_right, options.contradicted, left.map, work);
  if (work.cancelled()) return Work::interrupted();
  const auto last = static_cast<float>(input.disparities - 1);
  for (float& d : disparity_px.values()) d = std::clamp(d, 0.0F, last);
  return MatchOutput{median_3x3(disparity_px, work), std::move(confirmed)};
}

}  // namespace palpable::vision
