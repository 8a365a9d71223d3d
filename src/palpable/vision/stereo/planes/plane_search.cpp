// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_search.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace palpable::vision {
namespace {

constexpr int kCount = PlaneCandidates::kCount;
constexpr int kPaths = 8;

/// A vector of all candidates of a pixel.
using Lanes = float __attribute__((vector_size(sizeof(float) * kCount)));
using LaneMasks = int __attribute__((vector_size(sizeof(int) * kCount)));

/// The cost at a real disparity (Catmull-Rom interpolation), in units; linear beyond the volume's ends.
inline __attribute__((always_inline)) float cost_at(const std::uint16_t* cost, int count, float disparity,
                                                    float beyond_range_per_px) {
  constexpr float kUnit = 1.0F / kCostUnit;
  const auto value = [&](int d) { return static_cast<float>(cost[d]) * kUnit; };
  if (!(disparity >= 0.0F)) return value(0) - beyond_range_per_px * disparity;
  const auto last = static_cast<float>(count - 1);
  if (disparity > last) return value(count - 1) + beyond_range_per_px * (disparity - last);
  const int d = static_cast<int>(disparity);
  const float t = disparity - static_cast<float>(d);
  const float a = value(std::max(d - 1, 0));
  const float b = value(d);
  const float c = value(std::min(d + 1, count - 1));
  const float e = value(std::min(d + 2, count - 1));
  return b + 0.5F * t * (c - a + t * (2.0F * a - 5.0F * b + 4.0F * c - e + t * (3.0F * (b - c) + e - a)));
}

/// The cost at a pixel that matches as a nearer surface beside it: what lies behind costs no more.
inline __attribute__((always_inline)) float cost_beside_nearer(const std::uint16_t* cost, int count,
                                                               float disparity, float nearer,
                                                               float beyond_range_per_px) {
  const float own = cost_at(cost, count, disparity, beyond_range_per_px);
  if (!(disparity < nearer)) return own;
  return std::min(own, cost_at(cost, count, nearer, beyond_range_per_px) +
                           beyond_range_per_px * std::max(-disparity, 0.0F));
}

/// A candidate's cost including visibility in the other view.
inline __attribute__((always_inline)) float cost_with_other_view(const OtherView& other,
                                                                 const PlaneCostOptions& options, int x,
                                                                 int y, float disparity, float cost) {
  if (other.disparity == nullptr)
    return static_cast<float>(x) - disparity < static_cast<float>(other.first) - 0.5F ? options.hidden_cost
                                                                                      : cost;
  const int there = static_cast<int>(std::floor(static_cast<float>(x) - disparity + 0.5F));
  if (there < 0 || there >= other.disparity->width()) {
    cost = options.hidden_cost;
  } else {
    const float in_front = (*other.disparity)(there, y) - disparity;
    const float hidden = std::clamp((in_front - options.agreement_px) / options.ramp_px, 0.0F, 1.0F);
    const float conflict = std::clamp((-in_front - options.agreement_px) / options.ramp_px, 0.0F, 1.0F);
    cost += (options.hidden_cost - cost) * hidden + options.conflict_cost * conflict;
  }
  return cost + options.beyond_range_per_px * std::max(0.0F, other.least_px - disparity);
}

/// Sets the costs of row y's candidates; compiled for newer processors, whose rounding is one instruction.
PALPABLE_VECTORIZE
void plane_costs_of_row(const CostVolume& volume, const OtherView& other, const PlaneCostOptions& options,
                        int y, const Raster<float>* nearer_px, PlaneCandidates& candidates) {
  for (int x = 0; x < volume.width; ++x) {
    const std::uint16_t* cost = volume.at(x, y);
    const float nearer = nearer_px != nullptr ? (*nearer_px)(x, y) : NAN;
    const std::size_t at = candidates.at(x, y);
    for (std::size_t k = at; k < at + kCount; ++k) {
      const float d = candidates.disparity[k];
      const float matching =
          cost_beside_nearer(cost, volume.disparities, d, nearer, options.beyond_range_per_px);
      const float own = cost_with_other_view(other, options, x, y, d, matching);
      candidates.cost[k] =
          own + options.slope_cost * (std::fabs(candidates.slope_x[k]) + std::fabs(candidates.slope_y[k]));
    }
  }
}

/// The rows of candidates that a sweep reads.
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
  /// Smoothness weight to the predecessor for each of the four directions, `width` values each; negative = no
  /// predecessor.
  const float* weight;
  int width;
  int direction;
  float step_per_px;
  float largest_step;
};

/// The minimum by a tree reduction, which avoids a long dependency chain.
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

/// The candidates of one pixel, one in each lane.
struct CandidateLanes {
  Lanes disparity, slope_x, slope_y;
};

inline __attribute__((always_inline)) void load(const RowOfCandidates& row, std::size_t at,
                                                CandidateLanes& out) {
  std::memcpy(&out.disparity, row.disparity + at, sizeof out.disparity);
  std::memcpy(&out.slope_x, row.slope_x + at, sizeof out.slope_x);
  std::memcpy(&out.slope_y, row.slope_y + at, sizeof out.slope_y);
}

/// StepCosts between neighbours are compared as 16-bit integers, of this many steps per unit: a register then
/// holds the costs of all candidates.
constexpr float kStepsPerUnit = 512.0F;
/// Disparities, scaled to cost, are measured from the pixel's first candidate and limited to this range. Two
/// candidates beyond its end seem equal; but they are both wrong, since the first candidate is the pixel's
/// present plane and the range is larger than any largest step.
constexpr float kScaledRange = 8191.0F;
using StepCosts = std::int16_t __attribute__((vector_size(sizeof(std::int16_t) * kCount)));

/// Half of the candidates: a register of AVX2. The compiler splits comparisons of larger vectors into
/// scalars.
using Half = float __attribute__((vector_size(sizeof(float) * kCount / 2)));
using HalfMasks = int __attribute__((vector_size(sizeof(int) * kCount / 2)));
using HalfSteps = std::int16_t __attribute__((vector_size(sizeof(std::int16_t) * kCount / 2)));

/// Rounded to integers from 0 to `largest`. The halves are joined in registers: a vector that is read from
/// memory just after its halves were written there waits until both are in the cache.
inline __attribute__((always_inline)) void round_to(float largest, const Lanes& values, StepCosts& out) {
  const Half zero = {};
  const Half most = zero + largest;
  Half halves[2];
  std::memcpy(halves, &values, sizeof halves);
  HalfSteps whole[2];
  for (int k = 0; k < 2; ++k) {
    Half value = halves[k] + 0.5F;
    value = value > zero ? value : zero;
    value = value < most ? value : most;
    whole[k] = __builtin_convertvector(__builtin_convertvector(value, HalfMasks), HalfSteps);
  }
  static_assert(kCount == 16);
  out = __builtin_shufflevector(whole[0], whole[1], 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// A step from a pixel's predecessor to it.
struct PathStep {
  float dx, dy;
  /// Cost per pixel of either difference, and the largest step.
  float per_px, largest;
};

/// Adds the cost from the least path of the predecessor at which each candidate `here` is reached from any of
/// the predecessor's, whose path costs are `paths`, the least of them `least`.
inline __attribute__((always_inline)) void add_reach_from(const CandidateLanes& source, const Lanes& paths,
                                                          float least, const PathStep& step,
                                                          const CandidateLanes& here, Lanes& to) {
  const float scale = step.per_px * kStepsPerUnit;
  // The value of the first candidate is kScaledRange / 2.
  const float origin = 0.5F * kScaledRange - here.disparity[0] * scale;
  const float limit = step.largest * kStepsPerUnit;
  StepCosts on, back, carried, there, begin;
  round_to(kScaledRange, here.disparity * scale + origin, on);
  round_to(kScaledRange,
           (here.disparity - (here.slope_x * step.dx + here.slope_y * step.dy)) * scale + origin, back);
  // The source's planes continued to this pixel, and their disparities at the source.
  round_to(kScaledRange,
           (source.disparity + (source.slope_x * step.dx + source.slope_y * step.dy)) * scale + origin,
           carried);
  round_to(kScaledRange, source.disparity * scale + origin, there);
  round_to(limit, (paths - least) * kStepsPerUnit, begin);
  std::int16_t carried_of[kCount], there_of[kCount], begin_of[kCount];
  std::memcpy(carried_of, &carried, sizeof carried);
  std::memcpy(there_of, &there, sizeof there);
  std::memcpy(begin_of, &begin, sizeof begin);
  const StepCosts zero = {};
  StepCosts best = zero + static_cast<std::int16_t>(limit + 0.5F);
  for (int i = 0; i < kCount; ++i) {
    const StepCosts ahead = carried_of[i] - on, ahead_negative = -ahead;
    const StepCosts behind = there_of[i] - back, behind_negative = -behind;
    const StepCosts reached = begin_of[i] + (ahead > ahead_negative ? ahead : ahead_negative) +
                              (behind > behind_negative ? behind : behind_negative);
    best = reached < best ? reached : best;
  }
  to += __builtin_convertvector(__builtin_convertvector(best, LaneMasks), Lanes) * (1.0F / kStepsPerUnit);
}

/// One row of the four paths of a sweep: from the neighbour in the row, and from three neighbours in the
/// previous row.
PALPABLE_VECTORIZE
void sweep_row(const SweepRow& row) {
  const auto width = static_cast<std::size_t>(row.width);
  float beside[kCount] = {};
  float least_beside = 0.0F;
  for (int n = 0; n < row.width; ++n) {
    const auto x = static_cast<std::size_t>(row.direction > 0 ? n : row.width - 1 - n);
    const std::size_t at = x * kCount;
    CandidateLanes here;
    load(row.here, at, here);
    Lanes cost, total = {};
    std::memcpy(&cost, row.cost + at, sizeof cost);
    for (std::size_t k = 0; k < 4; ++k) {
      const int step_x = k < 2 ? row.direction : k == 2 ? 0 : -row.direction;
      const int step_y = k == 0 ? 0 : row.direction;
      const float weight = row.weight[k * width + x];
      Lanes path = cost;
      if (weight >= 0.0F) {
        const std::size_t from = x - static_cast<std::size_t>(step_x);
        const std::size_t slot = (k == 0 ? 0 : k - 1) * width + from;
        CandidateLanes source;
        load(k == 0 ? row.here : row.before, from * kCount, source);
        Lanes paths;
        std::memcpy(&paths, k == 0 ? beside : row.path_before->cost.data() + slot * kCount, sizeof paths);
        add_reach_from(source, paths, k == 0 ? least_beside : row.path_before->least[slot],
                       {static_cast<float>(step_x), static_cast<float>(step_y),
                        0.5F * row.step_per_px * weight, row.largest_step * weight},
                       here, path);
      }
      total += path;
      const float least = least_of(path);
      if (k == 0) {
        std::memcpy(beside, &path, sizeof path);
        least_beside = least;
      } else {
        const std::size_t slot = (k - 1) * width + x;
        std::memcpy(row.path->cost.data() + slot * kCount, &path, sizeof path);
        row.path->least[slot] = least;
      }
    }
    std::memcpy(row.sum + at, &total, sizeof total);
  }
}

/// Smoothness weights by colour difference.
class SmoothnessWeights {
 public:
  explicit SmoothnessWeights(const PlaneSmoothnessOptions& options) : diagonal_(options.diagonal_weight) {
    for (std::size_t i = 0; i < by_colour_.size(); ++i)
      by_colour_[i] =
          std::max(options.least_weight, std::exp(-static_cast<float>(i) / options.colour_levels));
  }
  /// The weights of row y to its predecessors in a sweep of this direction.
  void fill_row(const ColourPlanes& colour, int y, int direction, std::vector<float>& out) const {
    const int w = colour.width();
    for (int k = 0; k < 4; ++k) {
      const int step_x = k < 2 ? direction : k == 2 ? 0 : -direction;
      const int from_y = k == 0 ? y : y - direction;
      for (int x = 0; x < w; ++x) {
        float& weight = out[static_cast<std::size_t>(k * w + x)];
        weight = -1.0F;
        if (!colour.r.contains(x - step_x, from_y)) continue;
        weight = by_colour_[static_cast<std::size_t>(colour.difference(x, y, x - step_x, from_y))];
        if (k == 1 || k == 3) weight *= diagonal_;
      }
    }
  }

 private:
  std::array<float, 256> by_colour_{};
  float diagonal_;
};

void sweep(const ColourPlanes& colour, const PlaneSmoothnessOptions& options, int direction,
           PlaneCandidates& candidates, std::vector<float>& sum) {
  const SmoothnessWeights weights(options);
  const int w = candidates.width;
  const int h = candidates.height;
  PathRow before(w);
  PathRow path(w);
  std::vector<float> weight(static_cast<std::size_t>(w) * 4);
  const auto row_at = [&](int y) {
    const std::size_t at = candidates.at(0, y);
    return RowOfCandidates{candidates.disparity.data() + at, candidates.slope_x.data() + at,
                           candidates.slope_y.data() + at};
  };
  for (int n = 0; n < h; ++n) {
    const int y = direction > 0 ? n : h - 1 - n;
    weights.fill_row(colour, y, direction, weight);
    const std::size_t at = candidates.at(0, y);
    sweep_row({row_at(y), row_at(n == 0 ? y : y - direction), candidates.cost.data() + at, sum.data() + at,
               &before, &path, weight.data(), w, direction, options.step_per_px, options.largest_step});
    std::swap(before, path);
  }
}

}  // namespace

std::vector<Parameter> parameters_of(PlaneCostOptions& o) {
  return {{"slope_cost", &o.slope_cost, {0, 5}, "units", "Cost per unit of slope"},
          {"hidden_cost", &o.hidden_cost, {0, 4}, "units", "Cost of a pixel hidden from the other camera"},
          {"conflict_cost",
           &o.conflict_cost,
           {0, 4},
           "units",
           "Cost of a pixel that the other camera should see but does not"},
          {"beyond_range_per_px", &o.beyond_range_per_px, {0, 5}, "units", "Cost per pixel beyond the range"},
          {"agreement_px",
           &o.agreement_px,
           {0.1, 5},
           "px",
           "Disparities of both views that differ by less agree"},
          {"ramp_px", &o.ramp_px, {0.01, 5}, "px", "Hidden and conflict cost increase linearly over this"}};
}

std::vector<Parameter> parameters_of(PlaneSmoothnessOptions& o) {
  return {{"step_per_px",
           &o.step_per_px,
           {0, 10},
           "units",
           "Cost per pixel of disparity between neighbouring planes"},
          {"largest_step", &o.largest_step, {0, 10}, "units", "The smoothness cost is truncated here"},
          {"colour_levels", &o.colour_levels, {1, 255}, "levels", "Colour difference at which it falls by e"},
          {"least_weight", &o.least_weight, {0, 1}, "", "Weight across the strongest edge"},
          {"diagonal_weight", &o.diagonal_weight, {0, 1}, "", "Weight of diagonal neighbours"}};
}

float matching_cost_at(const CostVolume& volume, int x, int y, float disparity, float beyond_range_per_px) {
  return cost_at(volume.at(x, y), volume.disparities, disparity, beyond_range_per_px);
}

void plane_costs(const CostVolume& volume, const OtherView& other, const PlaneCostOptions& options,
                 PlaneCandidates& candidates, const Work& work, const Raster<float>* nearer_px) {
  parallel_for(work, volume.height, 4, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) plane_costs_of_row(volume, other, options, y, nearer_px, candidates);
  });
}

void choose_planes(const ColourPlanes& colour, const PlaneSmoothnessOptions& options,
                   PlaneCandidates& candidates, PlaneMap& out, const Work& work) {
  parallel_for(work, 2, 1, [&](int begin, int end) {
    for (int way = begin; way < end; ++way)
      sweep(colour, options, way == 0 ? 1 : -1, candidates,
            candidates.path_sum[static_cast<std::size_t>(way)]);
  });
  parallel_for(work, candidates.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < candidates.width; ++x) {
        const std::size_t at = candidates.at(x, y);
        std::size_t best = at;
        float least = std::numeric_limits<float>::max();
        for (std::size_t k = at; k < at + kCount; ++k) {
          // Every path includes the pixel's own cost, which must count only once (Drory et al. 2014).
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
