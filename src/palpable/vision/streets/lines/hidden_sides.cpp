// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/hidden_sides.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/streets/lines/beside_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace palpable::vision {
namespace {

/// The border of a street on one side of its line.
struct Side {
  double distance_px = 0.0;
  bool is_hidden = false;
};

/// The line's normal to the left at each point, and what is on both sides.
struct Profile {
  MapPoint normal;
  std::array<Side, 2> sides;
  bool is_known = false;
};

Profile profile_at(const CentreLine& line, std::size_t i, const Raster<std::uint8_t>& mask,
                   const Raster<std::uint8_t>& others, double reach_px, const HiddenSideOptions& options) {
  const auto around = static_cast<std::size_t>(options.direction_points);
  const auto& p = line.points;
  Profile out{normal_at(p, i, around), {}, value_at(mask, p[i]) != 0};
  for (std::size_t k = 0; k < 2 && out.is_known; ++k) {
    const double sign = k == 0 ? 1.0 : -1.0;
    double d = 0.0;
    while (d <= reach_px && value_at(mask, beside(p[i], out.normal, sign * d)) != 0) d += options.step_px;
    out.is_known = d <= reach_px;
    bool is_hidden = false;
    for (double v = d; v <= d + options.casing_px; v += options.step_px)
      is_hidden = is_hidden || value_at(others, beside(p[i], out.normal, sign * v)) != 0;
    out.sides[k] = {d, is_hidden};
  }
  return out;
}

/// Whether the line is in the middle of what can be seen: beside another carriageway it is not.
bool is_in_middle(const Profile& at, const HiddenSideOptions& options) {
  return at.is_known && std::abs(at.sides[0].distance_px - at.sides[1].distance_px) <= options.most_aside_px;
}

/// How far the street's middle is to the left of its line; nullopt where the borders do not tell it.
std::optional<double> shift_of(const Profile& at, double radius_px, const HiddenSideOptions& options) {
  if (!at.is_known || (at.sides[0].is_hidden && at.sides[1].is_hidden)) return std::nullopt;
  const bool is_left_hidden = at.sides[0].is_hidden;
  const double visible = at.sides[0].distance_px + at.sides[1].distance_px;
  if ((!is_left_hidden && !at.sides[1].is_hidden) || !is_in_middle(at, options) ||
      visible >= 2.0 * radius_px * options.most_visible)
    return 0.0;
  const double more = radius_px - at.sides[is_left_hidden ? 1 : 0].distance_px;
  return is_left_hidden ? more : -more;
}

std::vector<Profile> profiles_of(const CentreLine& line, const Raster<std::uint8_t>& mask,
                                 const Raster<std::uint8_t>& others, const HiddenSideOptions& options) {
  std::vector<Profile> out;
  const double reach = options.reach_radii * line.radius_px;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    out.push_back(profile_at(line, i, mask, others, reach, options));
  return out;
}

/// Half of what can be seen of a street's width: the median over the points of which one side is hidden, or
/// none; 0 if there are too few.
double radius_of(const std::vector<Profile>& profiles, bool hidden, const HiddenSideOptions& options) {
  std::vector<double> radii;
  for (const Profile& at : profiles)
    if (is_in_middle(at, options) && (at.sides[0].is_hidden != at.sides[1].is_hidden) == hidden &&
        !(at.sides[0].is_hidden && at.sides[1].is_hidden))
      radii.push_back(0.5 * (at.sides[0].distance_px + at.sides[1].distance_px));
  return radii.size() < static_cast<std::size_t>(options.fewest_points) ? 0.0 : quantile_of(radii, 0.5);
}

/// The shifts of all points: the median of those around each; 0 where none is known.
std::vector<double> shifts_of(const std::vector<Profile>& profiles, double radius_px,
                              const HiddenSideOptions& options) {
  std::vector<std::optional<double>> known;
  for (const Profile& at : profiles) known.push_back(shift_of(at, radius_px, options));
  std::vector<double> out(profiles.size(), 0.0);
  const auto reach = static_cast<std::size_t>(options.median_points);
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::vector<double> near;
    for (std::size_t k = i - std::min(i, reach); k < std::min(out.size(), i + reach + 1); ++k)
      if (known[k]) near.push_back(*known[k]);
    if (!near.empty()) out[i] = quantile_of(near, 0.5);
  }
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(HiddenSideOptions& o) {
  return {{"direction_points", &o.direction_points, {1, 50}, "points", "on both sides for a direction"},
          {"reach_radii", &o.reach_radii, {1, 10}, "radii", "how far away a border is looked for"},
          {"step_px", &o.step_px, {0.1, 5}, "px", "steps to it"},
          {"casing_px", &o.casing_px, {0, 20}, "px", "widest border between two streets"},
          {"fewest_points", &o.fewest_points, {1, 1000}, "points", "that show a street's width"},
          {"most_visible", &o.most_visible, {0, 1}, "", "part of the width where a side is hidden"},
          {"most_aside_px", &o.most_aside_px, {0, 50}, "px", "how far the line is beside the middle"},
          {"median_points", &o.median_points, {0, 100}, "points", "on both sides for a shift"}};
}

void centre_hidden_sides(CentreLines& graph, const Raster<std::uint8_t>& mask,
                         const Raster<std::uint8_t>& others, const HiddenSideOptions& options,
                         const CarriagewayOptions& widths) {
  std::vector<std::vector<Profile>> profiles;
  std::vector<double> radii;
  std::vector<MeasuredRadius> measured;
  for (const CentreLine& line : graph.lines) {
    profiles.push_back(profiles_of(line, mask, others, options));
    radii.push_back(radius_of(profiles.back(), false, options));
    if (radii.back() > 0.0) measured.push_back({radii.back(), length_px(line.points)});
  }
  std::vector<double> common = common_radii(std::move(measured), widths);
  std::sort(common.begin(), common.end());
  const std::vector<int> degrees = degrees_of(graph);
  for (std::size_t n = 0; n < graph.lines.size(); ++n) {
    CentreLine& line = graph.lines[n];
    double radius = radii[n];
    if (radius == 0.0) {
      const double visible = radius_of(profiles[n], true, options);
      const auto wider = std::lower_bound(common.begin(), common.end(), options.most_visible * visible);
      if (visible == 0.0 || wider == common.end()) continue;
      radius = *wider;
    }
    const std::vector<double> shifts = shifts_of(profiles[n], radius, options);
    const auto last = line.points.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const int node = i == 0 ? line.first : line.last;
      const bool is_end = i == 0 || i == last;
      if (is_end && degrees[static_cast<std::size_t>(node)] != 1) continue;
      line.points[i] = beside(line.points[i], profiles[n][i].normal, shifts[i]);
      if (is_end) graph.nodes[static_cast<std::size_t>(node)] = line.points[i];
    }
  }
}

}  // namespace palpable::vision
