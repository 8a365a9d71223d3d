// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace palpable::vision {
namespace {

std::uint32_t mixed(std::uint32_t a) {
  a = (a ^ (a >> 16)) * 0x7feb352dU;
  a = (a ^ (a >> 15)) * 0x846ca68bU;
  return a ^ (a >> 16);
}

/// Reproducible random numbers for one pixel and round.
class Draws {
 public:
  explicit Draws(std::uint32_t start) : state_(start) {}
  int up_to(int largest) { return 1 + static_cast<int>(next() % static_cast<std::uint32_t>(largest)); }
  float unit() { return static_cast<float>(static_cast<int>(next() % 2001U) - 1000) / 1000.0F; }

 private:
  std::uint32_t next() { return state_ = mixed(state_ + 0x9e3779b9U); }
  std::uint32_t state_;
};

/// Writes one pixel's candidates.
class Writer {
 public:
  Writer(PlaneCandidates& out, int x, int y) : out_(out), x_(x), y_(y), at_(out.at(x, y)) {}
  void add(float disparity, float slope_x, float slope_y) {
    out_.disparity[at_] = disparity;
    out_.slope_x[at_] = slope_x;
    out_.slope_y[at_] = slope_y;
    ++at_;
  }
  /// The plane of (px, py), clamped to the picture, continued to this pixel.
  void add_from(const PlaneMap& map, int px, int py) {
    px = std::clamp(px, 0, out_.width - 1);
    py = std::clamp(py, 0, out_.height - 1);
    const float sx = map.slope_x(px, py);
    const float sy = map.slope_y(px, py);
    add(map.disparity(px, py) + sx * static_cast<float>(x_ - px) + sy * static_cast<float>(y_ - py), sx, sy);
  }

 private:
  PlaneCandidates& out_;
  int x_, y_;
  std::size_t at_;
};

}  // namespace

PlaneCandidates::PlaneCandidates(int width_, int height_) : width(width_), height(height_) {
  const std::size_t n = at(0, height_);
  for (auto* values : {&disparity, &slope_x, &slope_y, &cost, &path_sum[0], &path_sum[1]}) values->resize(n);
}

std::vector<Parameter> parameters_of(PlaneProposalOptions& o) {
  std::vector<Parameter> all{
      {"near_reach_px", &o.near_reach_px, {1, 60}, "px", "Near neighbours are at most this far away"},
      {"first_change_px", &o.first_change_px, {0, 10}, "px", "Largest random change in the first round"},
      {"change_decay", &o.change_decay, {0, 1}, "", "Factor of the change from round to round"},
      {"least_change_px", &o.least_change_px, {0, 10}, "px", "Least random change"},
      {"second_change", &o.second_change, {0, 2}, "", "Change of the second changed candidate, as a share"},
      {"slope_change", &o.slope_change, {0, 2}, "", "Change of its slopes, as a share"}};
  for (std::size_t i = 0; i < o.far_reach_px.size(); ++i)
    all.push_back({"far_reach_px." + std::to_string(i),
                   &o.far_reach_px[i],
                   {1, 200},
                   "px",
                   "Far neighbours are at most this far away, in every eighth round"});
  append_parameters(all, "fine", parameters_of(o.fine));
  append_parameters(all, "broad", parameters_of(o.broad));
  append_parameters(all, "fit", parameters_of(o.fit));
  append_parameters(all, "regions", parameters_of(o.regions));
  return all;
}

void propose_planes(const ColourPlanes& colour, const KnownPlanes& known, const PlaneProposalOptions& options,
                    int round, PlaneCandidates& out, const Work& work) {
  const int reach = options.far_reach_px[static_cast<std::size_t>(round) % options.far_reach_px.size()];
  const float change =
      std::max(options.least_change_px,
               options.first_change_px * std::pow(options.change_decay, static_cast<float>(round)));
  const PlaneMap fine = fit_planes(colour, known.now, known.trust, options.fine, options.fit, work);
  const PlaneMap broad = fit_planes(colour, known.now, known.trust, options.broad, options.fit, work);
  const RegionPlanes of_region = planes_of_regions(known.regions, fine, known.trust, options.regions, work);
  parallel_for(work, out.height, 4, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < out.width; ++x) {
        Draws draws(static_cast<std::uint32_t>(y * out.width + x) * 64U + static_cast<std::uint32_t>(round) +
                    static_cast<std::uint32_t>(work.seed) * 0x85ebca6bU);
        Writer candidates(out, x, y);
        candidates.add_from(known.now, x, y);
        candidates.add_from(fine, x, y);
        candidates.add_from(broad, x, y);
        candidates.add_from(known.start, x, y);
        const int near = draws.up_to(options.near_reach_px);
        const int far = draws.up_to(reach);
        for (const auto& [from, away] : {std::pair{&fine, near}, std::pair{&broad, far}}) {
          candidates.add_from(*from, x - away, y);
          candidates.add_from(*from, x + away, y);
          candidates.add_from(*from, x, y - away);
          candidates.add_from(*from, x, y + away);
        }
        for (const RegionPlane& plane : of_region[static_cast<std::size_t>(known.regions.of_pixel(x, y))])
          candidates.add(plane.at(x, y), plane.slope_x, plane.slope_y);
        const float shift = draws.unit();
        candidates.add(fine.disparity(x, y) + shift * change, fine.slope_x(x, y), fine.slope_y(x, y));
        if (known.from_other_view != nullptr && std::isfinite(known.from_other_view->disparity(x, y))) {
          candidates.add_from(*known.from_other_view, x, y);
          continue;
        }
        const float shift_2 = options.second_change * draws.unit();
        const float turn_x = options.slope_change * draws.unit();
        const float turn_y = options.slope_change * draws.unit();
        candidates.add(known.now.disparity(x, y) + shift_2 * change,
                       known.now.slope_x(x, y) + turn_x * change, known.now.slope_y(x, y) + turn_y * change);
      }
  });
}

}  // namespace palpable::vision
