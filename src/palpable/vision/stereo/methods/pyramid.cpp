// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/pyramid.hpp"

#include "palpable/vision/stereo/cost/normalised_correlation.hpp"
#include "palpable/vision/stereo/occlusion/filling.hpp"
#include "palpable/vision/stereo/problem/picture_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

// Beeler et al. 2010 as Gomez 2012 describes it (chapter 8), with the corrected equations of docs/stereo.md;
// and Cochran & Medioni's refinement at edges.
namespace palpable::vision {
namespace {

constexpr int kUnmatched = -1;

/// The disparities tried at a pixel, each once.
class CandidateList {
 public:
  explicit CandidateList(int disparities) : seen_(static_cast<std::size_t>(disparities), 0) {}
  void clear() {
    for (const int d : list_) seen_[static_cast<std::size_t>(d)] = 0;
    list_.clear();
  }
  void add_around(int d) {
    for (int k = std::max(0, d - 1); k <= std::min(static_cast<int>(seen_.size()) - 1, d + 1); ++k) {
      if (seen_[static_cast<std::size_t>(k)] != 0) continue;
      seen_[static_cast<std::size_t>(k)] = 1;
      list_.push_back(k);
    }
  }
  const std::vector<int>& list() const { return list_; }

 private:
  std::vector<std::uint8_t> seen_;
  std::vector<int> list_;
};

/// One pyramid level of the pair with one picture as reference: `sign` is +1 for the left one, whose match is
/// at x - d.
struct View {
  const CorrelationPicture& own;
  const CorrelationPicture& other;
  int sign;
  int disparities;
  /// The right picture has content from this column on.
  int right_first;
  float error(int x, int y, int d) const { return correlation_error(own, other, x, y, x - sign * d); }
  bool visible(int x, int d) const {
    const int to = x - sign * d;
    return to >= 0 && to < own.width() && (sign > 0 ? to : x) >= right_first;
  }
};

int best_of(const View& view, int x, int y, const std::vector<int>& tried) {
  int best = kUnmatched;
  float least = 2.0F;
  for (const int d : tried) {
    if (!view.visible(x, d)) continue;
    const float error = view.error(x, y, d);
    if (error < least) {
      least = error;
      best = d;
    }
  }
  return best;
}

/// Tries all disparities without a coarser estimate, else twice the coarser disparities around the pixel.
Raster<int> first_match(const View& view, const Raster<int>& coarse, const Work& work) {
  const int width = view.own.width();
  const int height = view.own.height();
  Raster<int> out(width, height, kUnmatched);
  parallel_for(work, height, 8, [&](int begin, int end) {
    CandidateList tried(view.disparities);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      for (int x = 0; x < width; ++x) {
        tried.clear();
        if (coarse.empty()) {
          for (int d = 1; d < view.disparities + 2; d += 3)
            tried.add_around(std::min(d, view.disparities - 1));
        } else {
          for (int v = std::max(0, y / 2 - 1); v <= std::min(coarse.height() - 1, y / 2 + 1); ++v)
            for (int u = std::max(0, x / 2 - 1); u <= std::min(coarse.width() - 1, x / 2 + 1); ++u)
              tried.add_around(2 * coarse(u, v));
        }
        out(x, y) = best_of(view, x, y, tried.list());
      }
    }
  });
  return out;
}

/// More than half of the 3 x 3 neighbours lie within a pixel.
bool is_smooth(const Raster<int>& map, int x, int y) {
  int near = 0;
  int all = 0;
  for (int v = std::max(0, y - 1); v <= std::min(map.height() - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(map.width() - 1, x + 1); ++u) {
      if (u == x && v == y) continue;
      ++all;
      near += map(u, v) != kUnmatched && std::abs(map(u, v) - map(x, y)) <= 1 ? 1 : 0;
    }
  return 2 * near > all;
}

/// Smooth, mutual, and in order with its right neighbour: 1 where all hold.
Raster<std::uint8_t> constrained(const View& view, const Raster<int>& map, const Raster<int>& other) {
  Raster<std::uint8_t> out(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const int d = map(x, y);
      if (d == kUnmatched || !view.visible(x, d)) continue;
      const int back = other(x - view.sign * d, y);
      const bool mutual = back != kUnmatched && std::abs(back - d) <= 1;
      // Ordering is checked in the left picture alone: a disparity may exceed its right neighbour's by one.
      const bool has_next = view.sign > 0 && x + 1 < map.width() && map(x + 1, y) != kUnmatched;
      const bool in_order = !has_next || d - map(x + 1, y) <= 1;
      out(x, y) = mutual && in_order && is_smooth(map, x, y) ? 1 : 0;
    }
  }
  return out;
}

/// Pixels that violate a constraint are matched again near the disparities of consistent neighbours.
Raster<int> rematched(const View& view, const Raster<int>& map, const Raster<std::uint8_t>& kept, int reach,
                      const Work& work) {
  Raster<int> out = map;
  parallel_for(work, map.height(), 8, [&](int begin, int end) {
    CandidateList tried(view.disparities);
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        if (kept(x, y) != 0) continue;
        tried.clear();
        for (int v = std::max(0, y - reach); v <= std::min(map.height() - 1, y + reach); ++v)
          for (int u = std::max(0, x - reach); u <= std::min(map.width() - 1, x + reach); ++u)
            if (kept(u, v) != 0) tried.add_around(map(u, v));
        if (!tried.list().empty()) out(x, y) = best_of(view, x, y, tried.list());
      }
    }
  });
  return out;
}

/// Both pictures' maps of one level and their consistent pixels; the others are filled from the background.
struct Maps {
  Raster<int> left;
  Raster<int> right;
  Raster<std::uint8_t> kept;
};

void fill(Raster<int>& map, const Raster<std::uint8_t>& kept) {
  Raster<float> filled(map.width(), map.height());
  for (std::size_t i = 0; i < map.count(); ++i)
    filled.values()[i] = static_cast<float>(std::max(0, map.values()[i]));
  fill_from_background(kept, filled);
  for (std::size_t i = 0; i < map.count(); ++i) map.values()[i] = static_cast<int>(filled.values()[i]);
}

/// Trust: the correlation of consistent matches; others have no vote.
Raster<float> trust(const View& view, const Raster<int>& map, const Raster<std::uint8_t>& kept, float least,
                    const Work& work) {
  Raster<float> out(map.width(), map.height());
  parallel_for(work, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < out.width(); ++x)
        if (kept(x, y) != 0) out(x, y) = std::max(least, 1.0F - 2.0F * view.error(x, y, map(x, y)));
  });
  return out;
}

Maps match_level(const MatchInput& input, const PyramidOptions& options, const Work& work) {
  const bool is_coarsest = std::min(input.left.width(), input.left.height()) < 2 * options.coarsest_side_px ||
                           input.disparities < options.coarsest_disparities;
  Maps coarse;
  if (!is_coarsest) coarse = match_level(halved(input), options, work);
  if (work.cancelled()) return coarse;
  const CorrelationPicture left(input.left_grey, options.noise_levels);
  const CorrelationPicture right(input.right_grey, options.noise_levels);
  const View from_left{left, right, 1, input.disparities, input.right_first};
  const View from_right{right, left, -1, input.disparities, input.right_first};
  Maps out{first_match(from_left, coarse.left, work), first_match(from_right, coarse.right, work), {}};
  for (int round = 0; round < options.rematch_rounds; ++round) {
    const Raster<std::uint8_t> kept_left = constrained(from_left, out.left, out.right);
    const Raster<std::uint8_t> kept_right = constrained(from_right, out.right, out.left);
    Raster<int> again = rematched(from_left, out.left, kept_left, options.rematch_reach_px, work);
    out.right = rematched(from_right, out.right, kept_right, options.rematch_reach_px, work);
    out.left = std::move(again);
  }
  out.kept = constrained(from_left, out.left, out.right);
  const Raster<std::uint8_t> kept_right = constrained(from_right, out.right, out.left);
  fill(out.left, out.kept);
  fill(out.right, kept_right);
  // Inconsistent pixels, and noise on plain surfaces, take the disparity of similar pixels nearby.
  out.left = weighted_median(colour_planes(input.left), out.left,
                             trust(from_left, out.left, out.kept, options.least_trust, work),
                             input.disparities, options.median, work);
  out.right = weighted_median(colour_planes(input.right), out.right,
                              trust(from_right, out.right, kept_right, options.least_trust, work),
                              input.disparities, options.median, work);
  return out;
}

/// Target and weight of the photometric term (the errors at q - 1, q, q + 1).
std::pair<float, float> photometric(float before, float here, float after) {
  if (before < here && before < after) return {-0.5F, here - before};
  if (here <= before && here <= after) {
    const float curvature = before + after - 2.0F * here;
    return {curvature > 0.0F ? 0.5F * (before - after) / curvature : 0.0F, 0.5F * curvature};
  }
  return {0.5F, std::max(0.0F, here - after)};
}

/// d' = (w_p d_p + w_s d_s) / (w_p + w_s), over the whole map, options.iterations times.
void refine(const View& view, const PyramidOptions& options, Raster<float>& map, const Work& work) {
  Raster<float> next = map;
  for (int i = 0; i < options.iterations && !work.cancelled(); ++i) {
    parallel_for(work, map.height(), 8, [&](int begin, int end) {
      for (int y = std::max(1, begin); y < std::min(map.height() - 1, end); ++y) {
        for (int x = 1; x < map.width() - 1; ++x) {
          const float d = map(x, y);
          const auto q = static_cast<int>(std::lround(d));
          float target = d;
          float w_p = 0.0F;
          if (q >= 1 && q + 1 < view.disparities && view.visible(x, q - 1) && view.visible(x, q + 1)) {
            const auto [offset, weight] =
                photometric(view.error(x, y, q - 1), view.error(x, y, q), view.error(x, y, q + 1));
            target = static_cast<float>(q) + offset;
            w_p = std::max(0.0F, weight);
          }
          const auto beside = [&](int u, int v) {
            const float there = map(u, v);
            return std::abs(there - d) <= options.surface_px ? there : d;
          };
          const float left = beside(x - 1, y);
          const float right = beside(x + 1, y);
          const float up = beside(x, y - 1);
          const float down = beside(x, y + 1);
          const float bend_x = std::abs(left - d) - std::abs(right - d);
          const float bend_y = std::abs(up - d) - std::abs(down - d);
          const float w_x = std::exp(-bend_x * bend_x);
          const float w_y = std::exp(-bend_y * bend_y);
          const float smooth =
              w_x + w_y > 1e-6F ? (w_x * (left + right) + w_y * (up + down)) / (2.0F * (w_x + w_y)) : d;
          next(x, y) = (w_p * target + options.surface_weight * smooth) / (w_p + options.surface_weight);
        }
      }
    });
    std::swap(map, next);
  }
}

/// Cochran & Medioni 1992: a step in disparity belongs on an edge of the picture. Each step moves along its
/// scanline to the strongest edge within reach.
void move_steps_to_edges(const Raster<std::uint8_t>& grey, int reach, int least_contrast,
                         Raster<float>& map) {
  for (int y = 0; y < map.height(); ++y) {
    const auto row = map.row(y);
    const std::vector<float> before(row.begin(), row.end());
    const auto contrast = [&](int x) { return std::abs(grey(x + 1, y) - grey(x, y)); };
    for (int x = reach; x + reach + 1 < map.width(); ++x) {
      const auto i = static_cast<std::size_t>(x);
      if (std::abs(before[i + 1] - before[i]) <= 1.0F) continue;
      int edge = x;
      for (int u = x - reach; u <= x + reach; ++u)
        if (contrast(u) > std::max(contrast(edge), least_contrast)) edge = u;
      for (int u = edge + 1; u <= x; ++u) row[static_cast<std::size_t>(u)] = before[i + 1];
      for (int u = x + 1; u <= edge; ++u) row[static_cast<std::size_t>(u)] = before[i];
    }
  }
}

}  // namespace

std::vector<Parameter> parameters_of(PyramidOptions& o) {
  std::vector<Parameter> all{
      {"surface_weight",
       &o.surface_weight,
       {0.001, 100},
       "",
       "Weight of a smooth surface; the data term has 0 to 1"},
      {"iterations", &o.iterations, {0, 1000}, "", "Rounds of the refinement"},
      {"surface_px",
       &o.surface_px,
       {0.1, 100},
       "px",
       "Neighbours that differ by more are on another surface"},
      {"edge_reach_px", &o.edge_reach_px, {0, 60}, "px", "With features: greatest shift of disparity steps"},
      {"edge_levels", &o.edge_levels, {0, 255}, "levels", "With features: least contrast of an edge"},
      {"coarsest_side_px", &o.coarsest_side_px, {8, 10000}, "px", "Least short side of the coarsest picture"},
      {"coarsest_disparities", &o.coarsest_disparities, {2, 1000}, "", "Its least number of disparities"},
      {"rematch_rounds",
       &o.rematch_rounds,
       {0, 20},
       "",
       "Rounds in which inconsistent pixels are matched again"},
      {"rematch_reach_px", &o.rematch_reach_px, {1, 30}, "px", "Reach of their candidates"},
      {"noise_levels", &o.noise_levels, {0.1, 50}, "levels", "Standard deviation of a pixel's noise"},
      {"least_trust", &o.least_trust, {0.001, 1}, "", "Least weight of a consistent match"}};
  append_parameters(all, "median", parameters_of(o.median));
  return all;
}

Result<void> check(const PyramidOptions& options) { return check_ranges(options); }

Result<MatchOutput> match_pyramid(const MatchInput& input, const PyramidOptions& options, const Work& work) {
  if (const auto ok = check(options); !ok) return ok.error();
  work.report(0.1, "matching from coarse to fine");
  const Maps maps = match_level(input, options, work);
  if (work.cancelled()) return Work::interrupted();
  MatchOutput output{Raster<float>(maps.left.width(), maps.left.height()), {}};
  for (std::size_t i = 0; i < maps.left.count(); ++i)
    output.disparity_px.values()[i] = static_cast<float>(maps.left.values()[i]);
  if (options.edges == PyramidEdges::features)
    move_steps_to_edges(input.left_grey, options.edge_reach_px, options.edge_levels, output.disparity_px);
  work.report(0.7, "refining");
  const CorrelationPicture left(input.left_grey, options.noise_levels);
  const CorrelationPicture right(input.right_grey, options.noise_levels);
  refine({left, right, 1, input.disparities, input.right_first}, options, output.disparity_px, work);
  if (work.cancelled()) return Work::interrupted();
  return output;
}

}  // namespace palpable::vision
