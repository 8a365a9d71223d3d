// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_search.hpp"

#include "palpable/core/vectorize.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace palpable::vision {
namespace {

constexpr int kCount = PlaneCandidates::kCount;
constexpr int kPaths = 8;

// Costs in the units of the matching cost (0…2).
constexpr float kStep_per_px = 0.6F;
constexpr float kLargestStep = 3.0F;
constexpr float kLikeColour = 12.0F;
constexpr float kLeastTie = 0.08F;
constexpr float kDiagonalTie = 0.7F;
constexpr float kSlopeCost = 0.2F;
constexpr float kConflictCost = 0.7F;
constexpr float kBelowLeast_per_px = 0.5F;
/// Disparities of the two views agree up to this; from there the charges rise over half a pixel.
constexpr float kAgreement_px = 1.0F;
constexpr float kRamp_px = 0.5F;

/// A vector of all candidates of a pixel.
using Lanes = float __attribute__((vector_size(sizeof(float) * kCount)));
using LaneMasks = int __attribute__((vector_size(sizeof(int) * kCount)));

std::uint32_t mixed(std::uint32_t a) {
  a = (a ^ (a >> 16)) * 0x7feb352dU;
  a = (a ^ (a >> 15)) * 0x846ca68bU;
  return a ^ (a >> 16);
}

/// Reproducible draws for one pixel and round.
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
  /// The plane of (px, py), or of the nearest pixel inside, carried on to this pixel.
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

/// The cost at a disparity between those of the volume (Catmull-Rom), in units; linear beyond its ends.
float cost_at(const std::uint16_t* cost, int count, float disparity) {
  constexpr float kUnit = 1.0F / kCostUnit;
  const auto value = [&](int d) { return static_cast<float>(cost[std::clamp(d, 0, count - 1)]) * kUnit; };
  if (!(disparity >= 0.0F)) return value(0) - kBelowLeast_per_px * disparity;
  const auto last = static_cast<float>(count - 1);
  if (disparity > last) return value(count - 1) + kBelowLeast_per_px * (disparity - last);
  const int d = static_cast<int>(disparity);
  const float t = disparity - static_cast<float>(d);
  const float a = value(d - 1);
  const float b = value(d);
  const float c = value(d + 1);
  const float e = value(d + 2);
  return b + 0.5F * t * (c - a + t * (2.0F * a - 5.0F * b + 4.0F * c - e + t * (3.0F * (b - c) + e - a)));
}

float seen_from_other(const OtherView& other, int x, int y, float disparity, float cost) {
  if (other.disparity == nullptr)
    return static_cast<float>(x) - disparity < static_cast<float>(other.first) - 0.5F ? kHiddenCost : cost;
  const int there = static_cast<int>(std::floor(static_cast<float>(x) - disparity + 0.5F));
  if (there < 0 || there >= other.disparity->width()) {
    cost = kHiddenCost;
  } else {
    const float in_front = (*other.disparity)(there, y) - disparity;
    const float hidden = std::clamp((in_front - kAgreement_px) / kRamp_px, 0.0F, 1.0F);
    const float conflict = std::clamp((-in_front - kAgreement_px) / kRamp_px, 0.0F, 1.0F);
    cost += (kHiddenCost - cost) * hidden + kConflictCost * conflict;
  }
  return cost + kBelowLeast_per_px * std::max(0.0F, other.least_px - disparity);
}

/// The rows of candidates that a sweep looks at.
struct RowOfCandidates {
  const float* disparity;
  const float* slope_x;
  const float* slope_y;
};

/// Path costs of one row for the three directions that come from the row before.
struct PathRow {
  std::vector<float> cost, least;
  explicit PathRow(int width)
      : cost(static_cast<std::size_t>(width) * 3 * kCount), least(static_cast<std::size_t>(width) * 3) {}
};

struct SweepRow {
  RowOfCandidates here, before;
  const float* cost;
  float* sum;
  const PathRow* path_before;
  PathRow* path;
  /// Tie to the predecessor for each of the four directions, width values each; negative = there is none.
  const float* tie;
  int width;
  int direction;
};

/// The least of them, by halves: one after the other each would wait for the last.
inline __attribute__((always_inline)) float least_of(const Lanes& values) {
  static_assert(kCount == 16);
  using Eight = float __attribute__((vector_size(32)));
  using Four = float __attribute__((vector_size(16)));
  Eight low, high;
  std::memcpy(&low, &values, sizeof low);
  std::memcpy(&high, reinterpret_cast<const float*>(&values) + 8, sizeof high);
  low = low < high ? low : high;
  Four left, right;
  std::memcpy(&left, &low, sizeof left);
  std::memcpy(&right, reinterpret_cast<const float*>(&low) + 4, sizeof right);
  left = left < right ? left : right;
  const float first = left[0] < left[1] ? left[0] : left[1];
  const float second = left[2] < left[3] ? left[2] : left[3];
  return first < second ? first : second;
}

/// One row of the four paths whose predecessors come before it in the sweep: beside, and the three of the row
/// before.
PALPABLE_VECTORIZE
void sweep_row(const SweepRow& row) {
  const Lanes zero = {};
  const LaneMasks magnitude = reinterpret_cast<LaneMasks>(zero) + 0x7fffffff;
  float beside[kCount] = {};
  float least_beside = 0.0F;
  for (int n = 0; n < row.width; ++n) {
    const int x = row.direction > 0 ? n : row.width - 1 - n;
    const auto at = static_cast<std::size_t>(x) * kCount;
    Lanes disparity, slope_x, slope_y, cost;
    std::memcpy(&disparity, row.here.disparity + at, sizeof disparity);
    std::memcpy(&slope_x, row.here.slope_x + at, sizeof slope_x);
    std::memcpy(&slope_y, row.here.slope_y + at, sizeof slope_y);
    std::memcpy(&cost, row.cost + at, sizeof cost);
    Lanes total = zero;
    for (int k = 0; k < 4; ++k) {
      const int step_x = k < 2 ? row.direction : k == 2 ? 0 : -row.direction;
      const int step_y = k == 0 ? 0 : row.direction;
      const float tie = row.tie[static_cast<std::size_t>(k) * static_cast<std::size_t>(row.width) +
                                static_cast<std::size_t>(x)];
      Lanes path = cost;
      if (tie >= 0.0F) {
        const auto from = static_cast<std::size_t>(x - step_x);
        const auto slot =
            static_cast<std::size_t>(k == 0 ? 0 : k - 1) * static_cast<std::size_t>(row.width) + from;
        const RowOfCandidates& source = k == 0 ? row.here : row.before;
        const float* d = source.disparity + from * kCount;
        const float* sx = source.slope_x + from * kCount;
        const float* sy = source.slope_y + from * kCount;
        const float* paths = k == 0 ? beside : row.path_before->cost.data() + slot * kCount;
        const float least = k == 0 ? least_beside : row.path_before->least[slot];
        const auto dx = static_cast<float>(step_x);
        const auto dy = static_cast<float>(step_y);
        const float per_px = 0.5F * kStep_per_px * tie;
        const Lanes carried_back = disparity - (slope_x * dx + slope_y * dy);
        // The source's planes carried on to here, all at once: the loop then takes one of each as a scalar.
        Lanes source_d, source_sx, source_sy;
        std::memcpy(&source_d, d, sizeof source_d);
        std::memcpy(&source_sx, sx, sizeof source_sx);
        std::memcpy(&source_sy, sy, sizeof source_sy);
        const Lanes carried = source_d + (source_sx * dx + source_sy * dy);
        float carried_on[kCount];
        std::memcpy(carried_on, &carried, sizeof carried);
        Lanes best = zero + (least + kLargestStep * tie);
        for (int i = 0; i < kCount; ++i) {
          const Lanes ahead = carried_on[i] - disparity;
          const Lanes behind = d[i] - carried_back;
          const Lanes bend = reinterpret_cast<Lanes>(reinterpret_cast<LaneMasks>(ahead) & magnitude) +
                             reinterpret_cast<Lanes>(reinterpret_cast<LaneMasks>(behind) & magnitude);
          const Lanes reached = paths[i] + per_px * bend;
          best = reached < best ? reached : best;
        }
        path = cost + best - least;
      }
      total += path;
      float stored[kCount];
      std::memcpy(stored, &path, sizeof path);
      const float least = least_of(path);
      if (k == 0) {
        std::memcpy(beside, stored, sizeof stored);
        least_beside = least;
      } else {
        const auto slot = static_cast<std::size_t>(k - 1) * static_cast<std::size_t>(row.width) +
                          static_cast<std::size_t>(x);
        std::memcpy(row.path->cost.data() + slot * kCount, stored, sizeof stored);
        row.path->least[slot] = least;
      }
    }
    std::memcpy(row.sum + at, &total, sizeof total);
  }
}

class TieTable {
 public:
  TieTable() {
    for (std::size_t i = 0; i < tie_.size(); ++i)
      tie_[i] = std::max(kLeastTie, std::exp(-static_cast<float>(i) / kLikeColour));
  }
  /// Ties of row y to its predecessors in a sweep of this direction.
  void fill_row(const ColourPlanes& colour, int y, int direction, std::vector<float>& out) const {
    const int w = colour.width();
    for (int k = 0; k < 4; ++k) {
      const int step_x = k < 2 ? direction : k == 2 ? 0 : -direction;
      const int from_y = k == 0 ? y : y - direction;
      for (int x = 0; x < w; ++x) {
        float& tie = out[static_cast<std::size_t>(k * w + x)];
        tie = -1.0F;
        if (!colour.r.contains(x - step_x, from_y)) continue;
        tie = tie_[static_cast<std::size_t>(colour.difference(x, y, x - step_x, from_y))];
        if (k == 1 || k == 3) tie *= kDiagonalTie;
      }
    }
  }

 private:
  std::array<float, 256> tie_{};
};

void sweep(const ColourPlanes& colour, const TieTable& ties, int direction, PlaneCandidates& candidates,
           std::vector<float>& sum) {
  const int w = candidates.width;
  const int h = candidates.height;
  PathRow before(w);
  PathRow path(w);
  std::vector<float> tie(static_cast<std::size_t>(w) * 4);
  const auto row_at = [&](int y) {
    const std::size_t at = candidates.at(0, y);
    return RowOfCandidates{candidates.disparity.data() + at, candidates.slope_x.data() + at,
                           candidates.slope_y.data() + at};
  };
  for (int n = 0; n < h; ++n) {
    const int y = direction > 0 ? n : h - 1 - n;
    ties.fill_row(colour, y, direction, tie);
    const std::size_t at = candidates.at(0, y);
    sweep_row({row_at(y), row_at(n == 0 ? y : y - direction), candidates.cost.data() + at, sum.data() + at,
               &before, &path, tie.data(), w, direction});
    std::swap(before, path);
  }
}

}  // namespace

PlaneCandidates::PlaneCandidates(int width_, int height_) : width(width_), height(height_) {
  const std::size_t n = at(0, height_);
  for (auto* values : {&disparity, &slope_x, &slope_y, &cost, &path_sum[0], &path_sum[1]}) values->resize(n);
}

void propose_planes(const ColourPlanes& colour, const KnownPlanes& known, int round, PlaneCandidates& out,
                    const Work& work) {
  // Far neighbours by turns nearer and further, so that a plane crosses large untextured areas in few rounds.
  constexpr std::array kReach_px{2, 6, 14, 4, 20, 9, 3, 30};
  const int reach = kReach_px[static_cast<std::size_t>(round) % kReach_px.size()];
  const float change = std::max(0.06F, 0.5F * std::pow(0.6F, static_cast<float>(round)));
  const PlaneMap fine = fit_planes(colour, known.now, known.trust, {3, 1}, work);
  const PlaneMap broad = fit_planes(colour, known.now, known.trust, {12, 3}, work);
  const RegionPlanes of_region = planes_of_regions(known.regions, fine, known.trust, work);
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
        const int near = draws.up_to(3);
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
        if (known.across != nullptr && std::isfinite(known.across->disparity(x, y))) {
          candidates.add_from(*known.across, x, y);
          continue;
        }
        const float shift_2 = 0.5F * draws.unit();
        const float turn_x = 0.2F * draws.unit();
        const float turn_y = 0.2F * draws.unit();
        candidates.add(known.now.disparity(x, y) + shift_2 * change,
                       known.now.slope_x(x, y) + turn_x * change, known.now.slope_y(x, y) + turn_y * change);
      }
  });
}

float matching_cost_at(const CostVolume& volume, int x, int y, float disparity) {
  return cost_at(volume.at(x, y), volume.disparities, disparity);
}

void plane_costs(const CostVolume& volume, const OtherView& other, PlaneCandidates& candidates,
                 const Work& work) {
  parallel_for(work, volume.height, 4, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < volume.width; ++x) {
        const std::uint16_t* cost = volume.at(x, y);
        const std::size_t at = candidates.at(x, y);
        for (std::size_t k = at; k < at + kCount; ++k) {
          const float d = candidates.disparity[k];
          const float own = seen_from_other(other, x, y, d, cost_at(cost, volume.disparities, d));
          candidates.cost[k] =
              own + kSlopeCost * (std::fabs(candidates.slope_x[k]) + std::fabs(candidates.slope_y[k]));
        }
      }
  });
}

void choose_planes(const ColourPlanes& colour, PlaneCandidates& candidates, PlaneMap& out, const Work& work) {
  const TieTable ties;
  parallel_for(work, 2, 1, [&](int begin, int end) {
    for (int way = begin; way < end; ++way)
      sweep(colour, ties, way == 0 ? 1 : -1, candidates, candidates.path_sum[static_cast<std::size_t>(way)]);
  });
  parallel_for(work, candidates.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < candidates.width; ++x) {
        const std::size_t at = candidates.at(x, y);
        std::size_t best = at;
        float least = std::numeric_limits<float>::max();
        for (std::size_t k = at; k < at + kCount; ++k) {
          // Every path counts the pixel's own cost; once is right (Drory et al. 2014).
          const float sum = candidates.path_sum[0][k] + candidates.path_sum[1][k] -
                            static_cast<float>(kPaths - 1) * candidates.cost[k];
          if (sum < least) {
            least = sum;
            best = k;
          }
        }
        out.disparity(x, y) = candidates.disparity[best];
        out.slope_x(x, y) = candidates.slope_x[best];
        out.slope_y(x, y) = candidates.slope_y[best];
      }
  });
}

}  // namespace palpable::vision
