// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/leaf_fit.hpp"

#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/field_leaf.hpp"
#include "palpable/sculpt/field/leaf_errors.hpp"
#include "palpable/sculpt/field/leaf_quadratic.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

using models::DistanceSample;
using models::HalfAngle;
using models::LeafHead;
using models::Meeting;

/// One piece, in the form in which leaves store it.
struct Piece {
  bool curved = false;
  std::array<std::uint32_t, 6> words{};
  Vec3 normal;
};

std::uint32_t word(double value) { return std::bit_cast<std::uint32_t>(static_cast<float>(value)); }

/// The tangent plane of a sample, rounded so that leaves over the same face have the same words.
Piece plane_through(const CellSamples& samples, std::size_t k, double cell_m) {
  const DistanceSample& s = samples.at[k];
  // Adding zero turns -0 into 0.
  const auto rounded = [](double v, double step) { return std::round(v / step) * step + 0.0; };
  constexpr double kDirectionStep = 1.0 / (1 << 20);
  const Vec3 n{rounded(s.gradient.x, kDirectionStep), rounded(s.gradient.y, kDirectionStep),
               rounded(s.gradient.z, kDirectionStep)};
  const Vec3 x = samples.centre_m + samples.half_m * fit_place(k);
  Piece piece;
  piece.normal = n;
  piece.words = {word(n.x), word(n.y), word(n.z), word(rounded(s.distance_m - dot(n, x), cell_m / 2048.0))};
  return piece;
}

/// Quantised as the leaf's size allows: the tested values are the stored ones, and rounded numbers compress
/// better.
Piece quadratic_of(const Quadratic& c, double half_m, double cell_m) {
  const double value_step = cell_m / LeafHead::kValuesPerCell / half_m;
  const int level = std::ilogb(1.01 * 2.0 * half_m / cell_m);
  const int multiple = LeafHead::multiple(level);
  Piece piece;
  piece.curved = true;
  piece.words[0] = word(std::round(c[0] / value_step) * value_step + 0.0);
  for (std::size_t i = 1; i < kQuadraticTerms; ++i) {
    const double most = 32768.0 / multiple - 1.0;
    const double steps = std::clamp(std::round(c[i] / (multiple * LeafHead::kStep)), -most, most);
    const auto bits = static_cast<std::uint32_t>(multiple * static_cast<std::int32_t>(steps)) & 0xFFFFU;
    piece.words[1 + (i - 1) / 2] |= (i - 1) % 2 == 0 ? bits : bits << 16U;
  }
  piece.normal = models::rise_of(piece.words.data(), true);
  return piece;
}

/// A quadratic as a compact leaf; nullopt if it does not fit into one.
std::optional<LeafFit> compact_leaf_of(const Quadratic& c) {
  models::CompactQuadratic compact;
  const auto steps = [](double value, double step) {
    constexpr double kMost = 1e8;
    return static_cast<std::int32_t>(std::clamp(std::round(value / step), -kMost, kMost));
  };
  compact.middle = steps(c[0], models::CompactQuadratic::kMiddleStep);
  for (std::size_t k = 0; k < compact.numbers.size(); ++k)
    compact.numbers[k] = steps(c[k + 1], models::CompactQuadratic::step_of(k));
  if (!compact.fits()) return std::nullopt;
  LeafFit leaf;
  const auto words = models::words_of(compact);
  std::copy(words.begin(), words.end(), leaf.words.begin());
  leaf.count = words.size();
  return leaf;
}

/// Pieces that meet at less than a degree are one.
bool have_distinct_normals(HalfAngle half) { return half.sine > 0.01F; }

LeafFit leaf_of(std::span<const Piece> pieces, std::span<const Meeting> meetings) {
  LeafFit leaf;
  std::uint32_t head = static_cast<std::uint32_t>(pieces.size() - 1);
  for (std::size_t i = 0; i < pieces.size(); ++i) head |= (pieces[i].curved ? 1U : 0U) << (2 + i);
  for (std::size_t i = 0; i < meetings.size(); ++i)
    head |= (meetings[i] == Meeting::concave ? 1U : 0U) << (5 + i);
  leaf.words[leaf.count++] = head;
  leaf.count += 2 * meetings.size();
  for (const Piece& piece : pieces) {
    const std::size_t words = piece.curved ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
    std::copy_n(piece.words.begin(), words, leaf.words.begin() + static_cast<std::ptrdiff_t>(leaf.count));
    leaf.count += words;
  }
  models::set_half_angles(leaf.words.data());
  return leaf;
}

/// The samples whose directions differ most. They belong to the adjacent faces, since the directions of the
/// fan at their edge are in between.
struct Extremes {
  std::size_t a = 0, b = 0, c = 0;
  double ab = 0.0, c_from_both = 0.0;
};
Extremes extremes_of(const CellSamples& samples) {
  Vec3 mean;
  for (const DistanceSample& s : samples.at) mean += s.gradient / static_cast<double>(kFitPlaces);
  const auto farthest = [&](auto distance) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < kFitPlaces; ++k)
      if (distance(k) > distance(best) + 1e-12) best = k;
    return best;
  };
  const auto from = [&](std::size_t k, Vec3 g) { return squared_norm(samples.at[k].gradient - g); };
  Extremes e;
  e.a = farthest([&](std::size_t k) { return from(k, mean); });
  const Vec3 ga = samples.at[e.a].gradient;
  e.b = farthest([&](std::size_t k) { return from(k, ga); });
  const Vec3 gb = samples.at[e.b].gradient;
  const auto from_both = [&](std::size_t k) { return std::min(from(k, ga), from(k, gb)); };
  e.c = farthest(from_both);
  e.ab = from(e.b, ga);
  e.c_from_both = from_both(e.c);
  return e;
}

/// Tries leaf after leaf and keeps the best.
class Search {
 public:
  Search(const CellSamples& samples, const FitBounds& bounds)
      : samples_(samples), bounds_(bounds), errors_(samples, bounds), ends_(extremes_of(samples)) {}

  LeafFit run(const RecentLeaves& recent) {
    const double turn2 = ends_.ab;
    constexpr double kFlat = 1e-3;
    if (turn2 < 4e-4 && try_leaf(leaf_of(std::array{plane(kCentre)}, {}))) return best_;
    if (is_noisy() && turn2 < 2.0 && try_leaf(quadratic_leaf())) return best_;
    for (const LeafFit& leaf : recent.all())
      if (turn2 > kFlat && try_leaf(leaf)) return best_;
    if (turn2 > kFlat && try_planes()) return best_;
    if (!is_noisy() && turn2 < 2.0 && try_leaf(quadratic_leaf())) return best_;
    if (turn2 > kFlat && try_quadratics()) return best_;
    if (turn2 > kFlat && ends_.c_from_both > kFlat) try_corner();
    if (best_.count == 0) try_leaf(leaf_of(std::array{plane(kCentre)}, {}));
    if (!errors_.is_finest()) return best_;
    if (closest_m_ > kTooFar * bounds_.cell_m) try_all_planes();
    const double too_far_m = std::max(kTooFar * bounds_.cell_m, closest_m_);
    return errors_.greatest_m(best_, kNoLimit) > too_far_m ? closest_ : best_;
  }

 private:
  static constexpr std::size_t kCentre = kFitPlaces / 2;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  Piece plane(std::size_t k) const { return plane_through(samples_, k, bounds_.cell_m); }
  Piece quadratic(const Quadratic& c) const { return quadratic_of(c, samples_.half_m, bounds_.cell_m); }

  bool is_noisy() const { return samples_.coarse_turn > bounds_.noisy_turn; }
  /// One quadratic through all samples; compact where noise is larger than the steps of a compact leaf.
  LeafFit quadratic_leaf() const {
    const Quadratic c = quadratic_through(samples_);
    if (is_noisy() && errors_.may_be_compact())
      if (const auto compact = compact_leaf_of(c)) return *compact;
    return leaf_of(std::array{quadratic(c)}, {});
  }
  bool try_leaf(LeafFit leaf) {
    leaf.error = errors_.error(leaf, samples_.is_last ? std::max(1.0, best_.error) : 1.0);
    if (std::isfinite(leaf.error) && (best_.count == 0 || leaf.error < best_.error)) best_ = leaf;
    if (best_.count > 0 && best_.error <= 1.0) return true;
    if (errors_.is_finest()) keep_closest(leaf);
    return false;
  }
  /// If the best leaf of a finest cell has an error larger than the rounding of an edge, the leaf nearest to
  /// the true distance is used: where many faces meet, no leaf has the right gradient everywhere, and the one
  /// with the least gradient error may have a large distance error. In finest cells.
  static constexpr double kTooFar = 0.3;
  void keep_closest(LeafFit leaf) {
    const double greatest_m = errors_.greatest_m(leaf, closest_m_);
    if (!(greatest_m < closest_m_)) return;
    closest_m_ = greatest_m;
    leaf.error = std::max(leaf.error, 1.0 + 1e-9);
    closest_ = leaf;
  }
  /// Where many faces meet, the most different directions need not be those of the surface. So the most
  /// frequent planes of the samples are tried, in pairs and triples, and one smooth piece through all
  /// samples.
  void try_all_planes() {
    keep_closest(quadratic_leaf());
    std::vector<std::pair<int, Piece>> planes;
    for (std::size_t k = 0; k < kFitPlaces; ++k) {
      const Piece piece = plane(k);
      const auto known = std::find_if(planes.begin(), planes.end(),
                                      [&](const auto& p) { return p.second.words == piece.words; });
      if (known == planes.end())
        planes.emplace_back(1, piece);
      else
        ++known->first;
    }
    std::stable_sort(planes.begin(), planes.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr std::size_t kMost = 8;
    const std::size_t count = std::min(kMost, planes.size());
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j) {
        try_closest_pair(planes[i].second, planes[j].second);
        for (std::size_t k = j + 1; k < count; ++k)
          try_closest_corner({planes[i].second, planes[j].second, planes[k].second});
      }
  }
  void try_closest_pair(const Piece& a, const Piece& b) {
    if (!have_distinct_normals(models::half_angle_between(a.normal, b.normal))) return;
    for (const Meeting m : {Meeting::convex, Meeting::concave})
      keep_closest(leaf_of(std::array{a, b}, std::array{m}));
  }
  void try_closest_corner(const std::array<Piece, 3>& p) {
    for (const auto& order : kOrders) {
      const std::array<Piece, 3> pieces{p[order[0]], p[order[1]], p[order[2]]};
      if (!corner_has_distinct_normals(pieces)) continue;
      for (const Meeting m : {Meeting::convex, Meeting::concave})
        for (const Meeting n : {Meeting::convex, Meeting::concave})
          keep_closest(leaf_of(pieces, std::array{m, n}));
    }
  }
  /// The order of the two does not matter; a fixed order gives equal leaves for equal pieces.
  bool try_pair(Piece a, Piece b) {
    const HalfAngle half = models::half_angle_between(a.normal, b.normal);
    if (!have_distinct_normals(half)) return false;
    if (b.words < a.words) std::swap(a, b);
    return try_leaf(leaf_of(std::array{a, b}, std::array{Meeting::convex})) ||
           try_leaf(leaf_of(std::array{a, b}, std::array{Meeting::concave}));
  }
  bool try_planes() { return try_pair(plane(ends_.a), plane(ends_.b)); }
  bool try_quadratics() {
    const Vec3 ga = samples_.at[ends_.a].gradient, gb = samples_.at[ends_.b].gradient;
    std::array<bool, kFitPlaces> by_a{}, by_b{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < kFitPlaces; ++k) {
      const Vec3 g = samples_.at[k].gradient;
      by_a[k] = squared_norm(g - ga) < squared_norm(g - gb);
      by_b[k] = !by_a[k];
      count += by_a[k] ? 1 : 0;
    }
    constexpr std::size_t kLeast = 5;
    if (count < kLeast || kFitPlaces - count < kLeast) return false;
    const Piece a = quadratic(quadratic_through(samples_, by_a));
    const Piece b = quadratic(quadratic_through(samples_, by_b));
    return try_pair(a, b);
  }
  /// Which two of three pieces are joined first.
  static constexpr std::array<std::array<std::size_t, 3>, 3> kOrders{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
  static bool corner_has_distinct_normals(const std::array<Piece, 3>& p) {
    return have_distinct_normals(models::half_angle_between(p[0].normal, p[1].normal)) &&
           have_distinct_normals(models::half_angle_between(p[0].normal + p[1].normal, p[2].normal));
  }
  bool try_corner() {
    const std::array<Piece, 3> p{plane(ends_.a), plane(ends_.b), plane(ends_.c)};
    for (const auto& order : kOrders) {
      std::array<Piece, 3> pieces{p[order[0]], p[order[1]], p[order[2]]};
      if (pieces[1].words < pieces[0].words) std::swap(pieces[0], pieces[1]);
      if (!corner_has_distinct_normals(pieces)) continue;
      for (const Meeting m : {Meeting::convex, Meeting::concave})
        for (const Meeting n : {Meeting::convex, Meeting::concave})
          if (try_leaf(leaf_of(pieces, std::array{m, n}))) return true;
    }
    return false;
  }

  const CellSamples& samples_;
  const FitBounds& bounds_;
  LeafErrors errors_;
  Extremes ends_;
  LeafFit best_;
  LeafFit closest_;
  double closest_m_ = kNoLimit;
};

}  // namespace

void RecentLeaves::add(const LeafFit& leaf) {
  const LeafHead head{leaf.words[0]};
  if (head.pieces() < 2 || !head.flat()) return;
  const auto known =
      std::find_if(leaves_.begin(), leaves_.begin() + static_cast<std::ptrdiff_t>(count_),
                   [&](const LeafFit& l) { return std::ranges::equal(l.used(), leaf.used()); });
  if (known == leaves_.begin() + static_cast<std::ptrdiff_t>(count_) && count_ < kMost) ++count_;
  const auto last = std::min(known, leaves_.begin() + static_cast<std::ptrdiff_t>(count_) - 1);
  std::rotate(leaves_.begin(), last, last + 1);
  leaves_.front() = leaf;
}

LeafFit fit_leaf(const CellSamples& samples, const FitBounds& bounds, const RecentLeaves& recent) {
  return Search(samples, bounds).run(recent);
}

double leaf_error(const LeafFit& leaf, const CellSamples& samples, Vec3 u, const DistanceSample& truth,
                  const FitBounds& bounds) {
  LeafErrors::Squares squares;
  return LeafErrors(samples, bounds).at(leaf, u, truth, squares);
}

}  // namespace palpable::sculpt
