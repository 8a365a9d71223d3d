// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include "palpable/models/field/superquadric_distance.hpp"
#include "palpable/sculpt/points/point_index.hpp"
#include "palpable/sculpt/superquadric/part_fit.hpp"
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

class Splitter {
 public:
  Splitter(std::span<const Vec3> all, std::vector<Vec3> points, std::vector<std::uint8_t> labels,
           const std::optional<Point<SceneFrame>>& eye, const ShapeSetOptions& options, const Work& work)
      : points_(std::move(points)), labels_(std::move(labels)), eye_(eye), options_(options), work_(work) {
    const Vec3 size = bounds_of(points_).size_m();
    diagonal_m_ = norm(size);
    spacing_m_ = diagonal_m_ / std::sqrt(static_cast<double>(points_.size()));
    index_.emplace(points_, 2.0 * spacing_m_);
    tolerance_m_ = options.tolerance_m > 0.0 ? options.tolerance_m
                                             : std::max(options.tolerance_share * diagonal_m_,
                                                        options.tolerance_noises * noise_m());
    free_.emplace(all, eye_, options.free_tolerances * tolerance_m_, options.space);
    fitter_.emplace(PartFitter::Scene{points_, eye_, *free_, tolerance_m_, work.seed}, options_);
  }

  Result<ShapeSet> run() {
    work_.report(0.0, "cutting the points into parts");
    for (ShapePart& whole : connected()) cut(std::move(whole), 0);
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
    deform();
    deforms_pairs_ = true;
    join();
    if (work_.cancelled()) return Work::interrupted();
    return answer();
  }

 private:
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

  /// The connected pieces of some points of one label.
  std::vector<ShapePart> pieces(const Members& members, std::uint8_t label) const {
    std::vector<ShapePart> parts;
    for (Members& piece : pieces_of(points_, members, options_.gap_spacings * spacing_m_))
      parts.push_back({std::move(piece), label, {}});
    return parts;
  }
  /// The connected pieces of all points, label by label.
  std::vector<ShapePart> connected() const {
    std::map<std::uint8_t, Members> of_label;
    for (std::uint32_t i = 0; i < points_.size(); ++i) of_label[label(i)].push_back(i);
    std::vector<ShapePart> parts;
    for (const auto& [label, members] : of_label)
      for (ShapePart& part : pieces(members, label)) parts.push_back(std::move(part));
    return parts;
  }
  std::uint8_t label(std::uint32_t i) const { return labels_.empty() ? 0 : labels_[i]; }

  /// Cuts a part until each piece fits a shape: first along its largest plane, then at its neck.
  void cut(ShapePart part, int depth) {
    if (part.members.size() < kFewestPartPoints || work_.cancelled()) return;
    const bool last = depth == options_.most_cuts ||
                      part.members.size() < static_cast<std::size_t>(options_.least_cut_points);
    const double most_cost = last ? std::numeric_limits<double>::infinity() : fitter_->good_cost();
    fitter_->fit(part, most_cost);
    if (!fitter_->good(part)) fitter_->deform(part, most_cost);
    if (fitter_->good(part) || last) {
      parts_.push_back(std::move(part));
      return;
    }
    if (cut_from_plane(part, depth)) return;
    for (Members& side : cut_at_neck(points_, part.members, options_.gap_spacings * spacing_m_))
      for (ShapePart& piece : pieces(side, part.label)) cut(std::move(piece), depth + 1);
  }

  /// Cuts a part into the points on its largest plane and the connected pieces of the others; false if no
  /// plane holds enough points.
  bool cut_from_plane(const ShapePart& part, int depth) {
    const auto on =
        members_of_largest_plane(fitter_->places_of(part.members, static_cast<int>(part.members.size())),
                                 tolerance_m_, options_.least_plane_share, options_.slab, work_.seed);
    if (on.empty() || on.size() + kFewestPartPoints > part.members.size()) return false;
    Members flat, standing;
    for (std::size_t i = 0; i < part.members.size(); ++i) {
      const bool is_flat = flat.size() < on.size() && on[flat.size()] == i;
      (is_flat ? flat : standing).push_back(part.members[i]);
    }
    cut({std::move(flat), part.label, {}}, options_.most_cuts - 1);
    for (ShapePart& piece : pieces(standing, part.label)) cut(std::move(piece), depth + 1);
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
    pairs.reserve(meetings.size());
    for (const auto& [pair, count] : meetings) pairs.push_back(pair);
    return pairs;
  }

  /// Two parts as one, and what that saves.
  struct Joined {
    ShapePart part;
    double saving = 0.0;
  };
  using Pair = std::pair<std::size_t, std::size_t>;
  /// Fits a shape to the points of a and b together, if one costs less than `most_cost`: near that of the
  /// larger part where it holds nearly all of them.
  void fit_together(ShapePart& both, const ShapePart& a, const ShapePart& b, double most_cost) const {
    const ShapePart& larger = a.members.size() < b.members.size() ? b : a;
    if (larger.has_shape() && !larger.flat &&
        static_cast<double>(larger.members.size()) >=
            options_.near_share * static_cast<double>(both.members.size())) {
      fitter_->fit_near(both, larger, most_cost);
      if (!both.has_shape() && deforms_pairs_ && larger.parameters == kPlainParameters)
        fitter_->deform(both, most_cost);
      return;
    }
    fitter_->fit(both, most_cost);
    if (!both.has_shape() && (deforms_pairs_ || std::max(a.parameters, b.parameters) > kPlainParameters))
      fitter_->deform(both, most_cost);
  }
  Joined joined(const Pair& pair) const {
    const ShapePart &a = parts_[pair.first], &b = parts_[pair.second];
    Joined both;
    both.part.label = a.label;
    std::merge(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(),
               std::back_inserter(both.part.members));
    const double apart = fitter_->cost(a) + fitter_->cost(b);
    // One of the two shapes may be that of both.
    for (const ShapePart* one : {&a, &b}) {
      ShapePart kept = both.part;
      kept.fit = one->fit, kept.parameters = one->parameters, kept.flat = one->flat;
      if (one->has_shape()) fitter_->measure(kept);
      const double saving = apart - fitter_->cost(kept);
      if (one->has_shape() && saving > both.saving) both = {std::move(kept), saving};
    }
    ShapePart fitted;
    fitted.members = both.part.members, fitted.label = a.label;
    fit_together(fitted, a, b, apart - both.saving);
    const double saving = apart - fitter_->cost(fitted);
    if (fitted.has_shape() && saving > both.saving) both = {std::move(fitted), saving};
    return both;
  }
  void consider(const std::vector<Pair>& pairs, std::map<Pair, Joined>& possible) const {
    std::vector<Joined> found(pairs.size());
    parallel_for(work_, static_cast<int>(pairs.size()), 1, [&](int begin, int end) {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
        if (!work_.cancelled()) found[k] = joined(pairs[k]);
    });
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (found[k].saving > 0.0) possible.insert_or_assign(pairs[k], std::move(found[k]));
  }

  /// Joins adjacent pairs while that costs less, the greatest saving first.
  void join() {
    std::map<Pair, Joined> possible;
    consider(neighbours(), possible);
    while (!possible.empty() && !work_.cancelled()) {
      const auto best = std::max_element(possible.begin(), possible.end(), [](const auto& p, const auto& q) {
        return p.second.saving < q.second.saving;
      });
      const auto [a, b] = best->first;
      parts_[a] = std::move(best->second.part);
      parts_[b].members.clear();
      std::erase_if(possible, [&, a = a, b = b](const auto& p) {
        return p.first.first == a || p.first.first == b || p.first.second == a || p.first.second == b;
      });
      auto beside = neighbours();
      std::erase_if(beside, [a = a](const Pair& pair) { return pair.first != a && pair.second != a; });
      consider(beside, possible);
    }
    std::erase_if(parts_, [](const ShapePart& part) { return part.members.empty(); });
  }

  void deform() {
    parallel_for(work_, static_cast<int>(parts_.size()), 1, [&](int begin, int end) {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
        if (!work_.cancelled()) fitter_->deform(parts_[k]);
    });
  }

  /// Assigns each point to the nearest shape of its label and fits all shapes again; the better of old and
  /// new shape is kept.
  void assign_to_nearest() {
    std::vector<SuperquadricDistance> distances;
    std::vector<Members> members(parts_.size());
    std::vector<std::size_t> part;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      auto distance = SuperquadricDistance::from(parts_[k].fit.shape);
      if (!parts_[k].has_shape() || !distance) continue;
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
      ShapePart again;
      again.label = parts_[k].label;
      again.members = std::move(members[k]);
      ShapePart before = again;
      before.fit = parts_[k].fit, before.parameters = parts_[k].parameters, before.flat = parts_[k].flat;
      fitter_->fit(again);
      if (before.parameters > kPlainParameters) fitter_->deform(again);
      fitter_->measure(before);
      if (!again.has_shape() || fitter_->cost(before) < fitter_->cost(again)) again = std::move(before);
      parts_[k] = std::move(again);
    }
    std::erase_if(parts_,
                  [](const ShapePart& p) { return p.members.size() < kFewestPartPoints || !p.has_shape(); });
  }

  Result<ShapeSet> answer() {
    std::erase_if(parts_, [](const ShapePart& p) { return !p.has_shape(); });
    if (parts_.empty()) return invalid_input("holds points that no superquadric fits");
    std::stable_sort(parts_.begin(), parts_.end(), [](const ShapePart& a, const ShapePart& b) {
      return a.members.size() > b.members.size();
    });
    if (parts_.size() > static_cast<std::size_t>(options_.most_shapes))
      parts_.resize(static_cast<std::size_t>(options_.most_shapes));
    ShapeSet set;
    set.tolerance_m = tolerance_m_;
    std::size_t count = 0;
    for (ShapePart& part : parts_) {
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
  std::optional<FreeSpace> free_;
  std::optional<PartFitter> fitter_;
  std::vector<ShapePart> parts_;
  /// Whether a pair's common shape may be deformed though neither of its parts' is, which takes long.
  bool deforms_pairs_ = false;
  double diagonal_m_ = 0.0, spacing_m_ = 0.0, tolerance_m_ = 0.0;
};

}  // namespace

std::vector<Parameter> parameters_of(ShapeSetOptions& o) {
  std::vector<Parameter> parameters{
      {"tolerance_m", &o.tolerance_m, {0.0, 1000.0}, "m", "mean distance that is good enough; 0 = estimated"},
      {"tolerance_share", &o.tolerance_share, {0.0, 1.0}, "", "estimate: share of the points' diagonal"},
      {"tolerance_noises", &o.tolerance_noises, {0.0, 100.0}, "", "estimate: multiple of the noise"},
      {"resolution_share", &o.resolution_share, {0.01, 1.0}, "tolerances", "distance that does not count"},
      {"most_observations", &o.most_observations, {12, 1e6}, "", "what more points than this count as"},
      {"most_beyond", &o.most_beyond, {0.001, 1.0}, "", "greatest share of a surface in free space"},
      {"free_tolerances",
       &o.free_tolerances,
       {0.0, 100.0},
       "tolerances",
       "how far before points space is free"},
      {"free_places", &o.free_places, {1, 1e5}, "", "free places that a shape must avoid"},
      {"free_reach", &o.free_reach, {0.01, 10.0}, "", "their reach over the part's diagonal"},
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
      {"near_share",
       &o.near_share,
       {0.5, 1.1},
       "",
       "share of one part from which both are fitted near its shape"},
      {"used_points", &o.used_points, {12, 1e6}, "", "most points of all"},
      {"fitted_points", &o.fitted_points, {12, 1e6}, "", "most points of a fit"},
      {"measured_points", &o.measured_points, {12, 1e6}, "", "most points of an error"}};
  append_parameters(parameters, "slab", parameters_of(o.slab));
  append_parameters(parameters, "space", parameters_of(o.space));
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
  if (points_m.size() < kFewestPartPoints) return invalid_input("holds fewer than 12 points");
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
  return Splitter(points_m, std::move(points), std::move(kept_labels), eye, options, work).run();
}

}  // namespace palpable::sculpt
