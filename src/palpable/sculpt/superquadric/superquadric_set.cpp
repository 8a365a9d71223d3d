// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include "palpable/models/field/superquadric_distance.hpp"
#include "palpable/sculpt/points/point_index.hpp"
#include "palpable/sculpt/superquadric/point_parts.hpp"
#include "palpable/sculpt/superquadric/superquadric_starts.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace palpable::sculpt {
namespace {

using models::SuperquadricDistance;

constexpr std::size_t kFewest = 12;

/// A part of the points with its shape.
struct Part {
  Members members;
  std::uint8_t label = 0;
  FittedSuperquadric fit;
  /// Mean distance of the members, each at most options.most_tolerances tolerances.
  double error_m = std::numeric_limits<double>::infinity();
};

class Splitter {
 public:
  Splitter(std::vector<Vec3> points, std::vector<std::uint8_t> labels,
           const std::optional<Point<SceneFrame>>& eye, const ShapeSetOptions& options, const Work& work)
      : points_(std::move(points)), labels_(std::move(labels)), eye_(eye), options_(options), work_(work) {
    const Vec3 size = bounds_of(points_).size_m();
    diagonal_m_ = norm(size);
    spacing_m_ = diagonal_m_ / std::sqrt(static_cast<double>(points_.size()));
    index_.emplace(points_, 2.0 * spacing_m_);
    tolerance_m_ = options.tolerance_m > 0.0 ? options.tolerance_m
                                             : std::max(options.tolerance_share * diagonal_m_,
                                                        options.tolerance_noises * noise_m());
  }

  Result<ShapeSet> run() {
    work_.report(0.0, "cutting the points into parts");
    for (Part& whole : connected()) cut(std::move(whole), 0);
    if (work_.cancelled()) return Work::interrupted();
    // Joining decides which parts belong together; assigning points to their nearest shape corrects the
    // borders where parts were cut.
    for (int round = 0; round < options_.rounds; ++round) {
      work_.report(0.4 + 0.6 * round / options_.rounds, "joining parts that share a shape");
      join();
      if (work_.cancelled()) return Work::interrupted();
      assign_to_nearest();
    }
    join();
    if (work_.cancelled()) return Work::interrupted();
    return answer();
  }

 private:
  std::vector<Vec3> places_of(const Members& members, int most) const {
    std::vector<Vec3> places;
    const std::size_t count = std::min(static_cast<std::size_t>(most), members.size());
    places.reserve(count);
    for (std::size_t k = 0; k < count; ++k) places.push_back(points_[members[k * members.size() / count]]);
    return places;
  }

  /// Median distance of points from the plane fitted to their neighbours.
  double noise_m() const {
    constexpr std::size_t kSampled = 400, kNeighbours = 8;
    std::vector<double> heights;
    for (std::size_t k = 0; k < kSampled; ++k) {
      const Vec3 p = points_[k * points_.size() / kSampled];
      std::vector<Vec3> near;
      index_->within(p, 3.0 * spacing_m_, [&](std::uint32_t i, double) { near.push_back(points_[i]); });
      if (near.size() >= kNeighbours) heights.push_back(thickness_m(near));
    }
    return heights.empty() ? 0.0 : median_of(std::move(heights));
  }

  double error_of(const models::Superquadric& shape, std::span<const Vec3> places) const {
    const auto distance = SuperquadricDistance::from(shape);
    if (!distance || places.empty()) return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (const Vec3 p : places)
      sum += std::min(std::abs(distance->distance_m({p})), options_.most_tolerances * tolerance_m_);
    return sum / static_cast<double>(places.size());
  }

  /// Fits a slab if the members are flat, else a superquadric.
  void fit(Part& part) const {
    const auto places = places_of(part.members, options_.fitted_points),
               measured = places_of(part.members, options_.measured_points);
    part.error_m = std::numeric_limits<double>::infinity();
    if (places.size() < kFewest) return;
    if (thickness_m(places) < tolerance_m_) {
      part.fit = {slab_of(places, eye_, options_.slab), 0.0, 1.0, 0.0};
      part.error_m = error_of(part.fit.shape, measured);
      return;
    }
    std::optional<FitView> view;
    if (eye_) view = FitView{*eye_, {}};
    auto fitted = fit_superquadric(places, view, options_.fit);
    if (!fitted) return;
    part.fit = *std::move(fitted);
    part.error_m = error_of(part.fit.shape, measured);
    if (reaches_beyond(part.fit.shape, places)) part.error_m = std::numeric_limits<double>::infinity();
  }

  /// Whether a shape is much longer than its points along an axis (ShapeSetOptions::most_length), except for
  /// its hidden side.
  bool reaches_beyond(const models::Superquadric& shape, std::span<const Vec3> places) const {
    Vec3 middle;
    for (const Vec3 p : places) middle += p / static_cast<double>(places.size());
    const Vec3 away = eye_ ? unit(middle - eye_->v) : Vec3{};
    double across_m = 0.0;
    for (const Vec3 p : places)
      across_m = std::max(across_m, norm(p - middle - dot(p - middle, away) * away));
    const auto& r = shape.scene_from_shape.rotation;
    const std::array<double, 3> half_m{shape.size_m.x, shape.size_m.y, shape.size_m.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 axis{r[k], r[3 + k], r[6 + k]};
      double least_m = std::numeric_limits<double>::infinity(), most_m = -least_m;
      for (const Vec3 p : places) {
        least_m = std::min(least_m, dot(p, axis));
        most_m = std::max(most_m, dot(p, axis));
      }
      const double hidden_m = options_.most_hidden_length * across_m * std::abs(dot(axis, away));
      if (2.0 * half_m[k] > options_.most_length * (most_m - least_m) + hidden_m + 2.0 * tolerance_m_)
        return true;
    }
    return false;
  }

  bool good(const Part& part) const { return part.error_m <= tolerance_m_; }

  /// The connected pieces of some points of one label.
  std::vector<Part> pieces(const Members& members, std::uint8_t label) const {
    std::vector<Part> parts;
    for (Members& piece : pieces_of(points_, members, options_.gap_spacings * spacing_m_))
      parts.push_back({std::move(piece), label, {}});
    return parts;
  }
  /// The connected pieces of all points, label by label.
  std::vector<Part> connected() const {
    std::map<std::uint8_t, Members> of_label;
    for (std::uint32_t i = 0; i < points_.size(); ++i) of_label[label(i)].push_back(i);
    std::vector<Part> parts;
    for (const auto& [label, members] : of_label)
      for (Part& part : pieces(members, label)) parts.push_back(std::move(part));
    return parts;
  }
  std::uint8_t label(std::uint32_t i) const { return labels_.empty() ? 0 : labels_[i]; }

  /// Cuts a part until each piece fits a shape: first along its largest plane, then across its longest
  /// extent.
  void cut(Part part, int depth) {
    if (part.members.size() < kFewest || work_.cancelled()) return;
    fit(part);
    if (good(part) || depth == options_.most_cuts ||
        part.members.size() < static_cast<std::size_t>(options_.least_cut_points)) {
      parts_.push_back(std::move(part));
      return;
    }
    if (cut_from_plane(part, depth)) return;
    for (Members& half : halved(points_, part.members)) cut({std::move(half), part.label, {}}, depth + 1);
  }

  /// Cuts a part into the points on its largest plane and the connected pieces of the others; false if no
  /// plane holds enough points.
  bool cut_from_plane(const Part& part, int depth) {
    const auto on =
        members_of_largest_plane(places_of(part.members, static_cast<int>(part.members.size())), tolerance_m_,
                                 options_.least_plane_share, options_.slab, work_.seed);
    if (on.empty() || on.size() + kFewest > part.members.size()) return false;
    Members flat, standing;
    for (std::size_t i = 0; i < part.members.size(); ++i) {
      const bool is_flat = flat.size() < on.size() && on[flat.size()] == i;
      (is_flat ? flat : standing).push_back(part.members[i]);
    }
    cut({std::move(flat), part.label, {}}, options_.most_cuts - 1);
    for (Part& piece : pieces(standing, part.label)) cut(std::move(piece), depth + 1);
    return true;
  }

  /// Pairs of parts with adjacent points.
  std::vector<std::pair<std::size_t, std::size_t>> neighbours() const {
    std::vector<std::uint32_t> part_of(points_.size(), std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t k = 0; k < parts_.size(); ++k)
      for (const std::uint32_t i : parts_[k].members) part_of[i] = k;
    std::map<std::pair<std::size_t, std::size_t>, int> meetings;
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      index_->within(points_[i], options_.gap_spacings * spacing_m_, [&](std::uint32_t j, double) {
        const std::uint32_t a = part_of[i], b = part_of[j];
        constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
        if (a < b && b != kNone && parts_[a].label == parts_[b].label) ++meetings[{a, b}];
      });
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& [pair, count] : meetings) pairs.push_back(pair);
    return pairs;
  }

  /// Two parts as one, if one shape fits each of them.
  std::optional<Part> joined(const Part& a, const Part& b) const {
    Part both;
    both.label = a.label;
    std::merge(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(),
               std::back_inserter(both.members));
    fit(both);
    // The common shape must fit a part that fitted before, and must not be worse for one that did not.
    const auto is_acceptable = [&](const Part& part) {
      const double before_m = std::min(part.error_m, options_.most_tolerances * tolerance_m_);
      return error_of(both.fit.shape, places_of(part.members, options_.measured_points)) <=
             std::max(tolerance_m_, before_m);
    };
    if (!std::isfinite(both.error_m) || !is_acceptable(a) || !is_acceptable(b)) return std::nullopt;
    return both;
  }

  /// Joins adjacent pairs that one shape fits, the best fitting first.
  void join() {
    std::map<std::pair<std::size_t, std::size_t>, Part> possible;
    const auto consider = [&](std::size_t a, std::size_t b) {
      if (work_.cancelled()) return;
      if (auto both = joined(parts_[a], parts_[b])) possible.emplace(std::pair(a, b), *std::move(both));
    };
    for (const auto& [a, b] : neighbours()) consider(a, b);
    while (!possible.empty() && !work_.cancelled()) {
      const auto best = std::min_element(possible.begin(), possible.end(), [](const auto& p, const auto& q) {
        return p.second.error_m < q.second.error_m;
      });
      const auto [a, b] = best->first;
      parts_[a] = std::move(best->second);
      parts_[b].members.clear();
      std::erase_if(possible, [&, a = a, b = b](const auto& p) {
        return p.first.first == a || p.first.first == b || p.first.second == a || p.first.second == b;
      });
      for (const auto& [c, d] : neighbours())
        if (c == a || d == a) consider(c, d);
    }
    std::erase_if(parts_, [](const Part& part) { return part.members.empty(); });
  }

  /// Assigns each point to the nearest shape of its label and fits all shapes again; the better of old and
  /// new shape is kept.
  void assign_to_nearest() {
    std::vector<SuperquadricDistance> distances;
    std::vector<Members> members(parts_.size());
    std::vector<std::size_t> part;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      auto distance = SuperquadricDistance::from(parts_[k].fit.shape);
      if (!std::isfinite(parts_[k].error_m) || !distance) continue;
      distances.push_back(*std::move(distance));
      part.push_back(k);
    }
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      double least_m = options_.most_tolerances * tolerance_m_;
      std::size_t nearest = parts_.size();
      for (std::size_t k = 0; k < part.size(); ++k) {
        if (parts_[part[k]].label != label(i)) continue;
        const double distance_m = std::abs(distances[k].distance_m({points_[i]}));
        if (distance_m < least_m) least_m = distance_m, nearest = part[k];
      }
      if (nearest < parts_.size()) members[nearest].push_back(i);
    }
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      Part again;
      again.label = parts_[k].label;
      again.members = std::move(members[k]);
      fit(again);
      const double as_it_was_m =
          error_of(parts_[k].fit.shape, places_of(again.members, options_.measured_points));
      if (again.error_m > as_it_was_m) again.fit = parts_[k].fit, again.error_m = as_it_was_m;
      parts_[k] = std::move(again);
    }
    std::erase_if(parts_,
                  [](const Part& p) { return p.members.size() < kFewest || !std::isfinite(p.error_m); });
  }

  Result<ShapeSet> answer() {
    std::erase_if(parts_, [](const Part& p) { return !std::isfinite(p.error_m); });
    if (parts_.empty()) return invalid_input("holds points that no superquadric fits");
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const Part& a, const Part& b) { return a.members.size() > b.members.size(); });
    if (parts_.size() > static_cast<std::size_t>(options_.most_shapes))
      parts_.resize(static_cast<std::size_t>(options_.most_shapes));
    ShapeSet set;
    set.tolerance_m = tolerance_m_;
    std::size_t count = 0;
    for (Part& part : parts_) {
      part.fit.error_m = part.error_m;
      set.error_m += static_cast<double>(part.members.size()) * part.error_m;
      count += part.members.size();
      set.shapes.push_back(part.fit);
    }
    set.error_m /= static_cast<double>(count);
    set.left_out = 1.0 - static_cast<double>(count) / static_cast<double>(points_.size());
    return set;
  }

  std::vector<Vec3> points_;
  std::vector<std::uint8_t> labels_;
  std::optional<Point<SceneFrame>> eye_;
  ShapeSetOptions options_;
  const Work& work_;
  std::optional<PointIndex> index_;
  std::vector<Part> parts_;
  double diagonal_m_ = 0.0, spacing_m_ = 0.0, tolerance_m_ = 0.0;
};

}  // namespace

std::vector<Parameter> parameters_of(ShapeSetOptions& o) {
  std::vector<Parameter> parameters{
      {"tolerance_m", &o.tolerance_m, {0.0, 1000.0}, "m", "mean distance that is good enough; 0 = estimated"},
      {"tolerance_share", &o.tolerance_share, {0.0, 1.0}, "", "estimate: share of the points' diagonal"},
      {"tolerance_noises", &o.tolerance_noises, {0.0, 100.0}, "", "estimate: multiple of the noise"},
      {"most_shapes", &o.most_shapes, {1, 256}, "", "greatest number of shapes"},
      {"most_tolerances", &o.most_tolerances, {1.0, 100.0}, "tolerances", "truncation of a point's distance"},
      {"most_cuts", &o.most_cuts, {1, 12}, "", "greatest number of successive cuts of a part"},
      {"least_cut_points", &o.least_cut_points, {12, 1e6}, "", "points that a part needs to be cut"},
      {"least_plane_share",
       &o.least_plane_share,
       {0.01, 1.0},
       "",
       "share of a part's points on a plane to cut along it"},
      {"gap_spacings", &o.gap_spacings, {0.5, 20.0}, "spacings", "points within this are connected"},
      {"most_length", &o.most_length, {1.0, 10.0}, "", "length of a shape over that of its points"},
      {"most_hidden_length", &o.most_hidden_length, {0.0, 100.0}, "", "the same for its hidden side"},
      {"rounds", &o.rounds, {0, 100}, "", "rounds of joining parts and assigning points"},
      {"used_points", &o.used_points, {12, 1e6}, "", "most points of all"},
      {"fitted_points", &o.fitted_points, {12, 1e6}, "", "most points of a fit"},
      {"measured_points", &o.measured_points, {12, 1e6}, "", "most points of an error"}};
  append_parameters(parameters, "slab", parameters_of(o.slab));
  append_parameters(parameters, "fit", parameters_of(o.fit));
  return parameters;
}

Result<ShapeSet> fit_superquadrics(std::span<const Vec3> points_m, std::span<const std::uint8_t> labels,
                                   const std::optional<Point<SceneFrame>>& eye,
                                   const ShapeSetOptions& options, const Work& work) {
  if (const auto valid = check_ranges(options); !valid) return valid.error();
  if (const auto valid = check(options.fit); !valid) return valid.error();
  if (!labels.empty() && labels.size() != points_m.size())
    return Error{ErrorCode::usage, "each point needs a label, or none has one", {}};
  if (points_m.size() < kFewest) return invalid_input("holds fewer than 12 points");
  if (!std::all_of(points_m.begin(), points_m.end(), [](Vec3 p) { return is_finite(p); }))
    return invalid_input("holds a point that is not a finite number");
  const Vec3 size = bounds_of(points_m).size_m();
  if (!(std::max({size.x, size.y, size.z}) > 0.0))
    return invalid_input("holds points that are all at one place");
  std::vector<Vec3> points;
  std::vector<std::uint8_t> kept_labels;
  for (const std::uint32_t i : thinned(points_m, static_cast<std::size_t>(options.used_points))) {
    points.push_back(points_m[i]);
    if (!labels.empty()) kept_labels.push_back(labels[i]);
  }
  return Splitter(std::move(points), std::move(kept_labels), eye, options, work).run();
}

}  // namespace palpable::sculpt
