// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/plane_sweep.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/census.hpp"
#include "palpable/vision/image/luma.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Dense>

namespace palpable::vision {
namespace {

constexpr std::uint16_t kUnseen = 0xFFFF;

std::uint32_t packed(Rgb8 p) {
  return p.r | static_cast<std::uint32_t>(p.g) << 8U | static_cast<std::uint32_t>(p.b) << 16U;
}

// The positions of a pixel in another picture at steps 0, 1 …, as indices of its pixels; -1 outside it.
struct PixelLine {
  std::array<float, 3> start{}, step{};
  int width = 0, height = 0, steps = 0;
};
PALPABLE_VECTORIZE void find_places(const PixelLine& line, std::int32_t* __restrict out) {
  const float right = static_cast<float>(line.width) - 0.5F, bottom = static_cast<float>(line.height) - 0.5F;
  const auto [x, y, z] = line.start;
  const auto [dx, dy, dz] = line.step;
  const int width = line.width;
  for (int i = 0; i < line.steps; ++i) {
    const auto k = static_cast<float>(i);
    const float depth = z + k * dz;
    const float scale = 1.0F / depth;
    const float u = (x + k * dx) * scale, v = (y + k * dy) * scale;
    const bool inside = (depth > 0.0F) & (u > -0.5F) & (v > -0.5F) & (u < right) & (v < bottom);
    const float u0 = inside ? u : 0.0F, v0 = inside ? v : 0.0F;
    const std::int32_t place =
        static_cast<std::int32_t>(v0 + 0.5F) * width + static_cast<std::int32_t>(u0 + 0.5F);
    out[i] = inside ? place : -1;
  }
}

// The pixel of the reference that is compared.
struct Wanted {
  std::uint64_t census = 0, mask = 0;
  int scale = 0;
  std::int32_t r = 0, g = 0, b = 0;
};
struct CostTables {
  const std::uint16_t* colour;
  const std::uint16_t* census;
};
PALPABLE_VECTORIZE void costs_at(const std::int32_t* __restrict places, int count, const Wanted& wanted,
                                 const std::uint64_t* __restrict census,
                                 const std::uint32_t* __restrict colour, CostTables tables,
                                 std::uint16_t* __restrict out) {
  for (int i = 0; i < count; ++i) {
    if (places[i] < 0) {
      out[i] = kUnseen;
      continue;
    }
    const int bits = std::min(63, std::popcount((wanted.census ^ census[places[i]]) & wanted.mask) *
                                      wanted.scale / kCensusScaleUnit);
    const std::uint32_t there = colour[places[i]];
    const int r = std::abs(static_cast<int>(there & 255U) - wanted.r),
              g = std::abs(static_cast<int>(there >> 8U & 255U) - wanted.g),
              b = std::abs(static_cast<int>(there >> 16U) - wanted.b);
    const int most = r > g ? r : g;
    out[i] = static_cast<std::uint16_t>(tables.colour[most > b ? most : b] + tables.census[bits]);
  }
}

PALPABLE_VECTORIZE void exchange_sorted(std::uint16_t* __restrict least, std::uint16_t* __restrict most,
                                        std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t a = least[i], b = most[i];
    least[i] = a < b ? a : b;
    most[i] = a < b ? b : a;
  }
}

// How many of the least costs count where `seen` pictures see a pixel.
using UsedOf = std::array<std::uint16_t, PlaneSweep::kMostOthers + 1>;

PALPABLE_VECTORIZE void count_seen(const std::uint16_t* __restrict costs, std::size_t count,
                                   std::uint16_t* __restrict seen) {
  for (std::size_t i = 0; i < count; ++i)
    seen[i] = static_cast<std::uint16_t>(seen[i] + (costs[i] != kUnseen ? 1 : 0));
}

PALPABLE_VECTORIZE void add_used(const std::uint16_t* __restrict costs, std::size_t count,
                                 const std::uint16_t* __restrict used, std::uint16_t rank,
                                 std::uint32_t* __restrict sum) {
  for (std::size_t i = 0; i < count; ++i) sum[i] += rank < used[i] ? costs[i] : 0U;
}

PALPABLE_VECTORIZE void divide_by_used(const std::uint32_t* __restrict sum, std::size_t count,
                                       const std::uint16_t* __restrict used, std::uint16_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    // Half a unit keeps whole quotients whole.
    const float mean = (static_cast<float>(sum[i]) + 0.5F) / static_cast<float>(used[i]);
    out[i] = used[i] == 0 ? static_cast<std::uint16_t>(kCostUnit) : static_cast<std::uint16_t>(mean);
  }
}

// The mean of the least costs over the counted share of the other pictures. `costs`: a row for each picture.
struct RobustMean {
  RobustMean(std::size_t others_, std::size_t steps_, double share)
      : others(others_), steps(steps_), used(steps_), sum(steps_) {
    for (std::size_t seen = 1; seen < used_of.size(); ++seen)
      used_of[seen] = static_cast<std::uint16_t>(std::max(1.0, std::ceil(share * static_cast<double>(seen))));
  }
  void operator()(std::uint16_t* costs, std::uint16_t* out) {
    std::fill(used.begin(), used.end(), std::uint16_t{0});
    std::fill(sum.begin(), sum.end(), 0U);
    for (std::size_t o = 0; o < others; ++o) count_seen(costs + o * steps, steps, used.data());
    for (std::uint16_t& count : used) count = used_of[count];
    for (std::size_t rank = 0; rank < used_of[others]; ++rank) {
      for (std::size_t o = others - 1; o > rank; --o)
        exchange_sorted(costs + (o - 1) * steps, costs + o * steps, steps);
      add_used(costs + rank * steps, steps, used.data(), static_cast<std::uint16_t>(rank), sum.data());
    }
    divide_by_used(sum.data(), steps, used.data(), out);
  }
  std::size_t others, steps;
  UsedOf used_of{};
  std::vector<std::uint16_t> used;
  std::vector<std::uint32_t> sum;
};

std::uint16_t saturating_cost(double difference, double scale) {
  return static_cast<std::uint16_t>(std::lround(kCostUnit * (1 - std::exp(-difference / scale))));
}

double longest_line_px(std::span<const PosedFrame> others, const PosedFrame& reference, const Pinhole& camera,
                       const SweptPlanes& planes) {
  double longest = 0.0;
  for (const PosedFrame& other : others) {
    const EpipolarLine line(reference, other, camera);
    for (const int x : {0, camera.width / 2, camera.width - 1})
      for (const int y : {0, camera.height / 2, camera.height - 1}) {
        const double per_distance = dot(planes.normal, line_of_sight(camera, x, y));
        const auto near = line.place(x, y, per_distance / planes.near),
                   far = line.place(x, y, per_distance / planes.far);
        longest = std::max(longest, std::hypot(near[0] - far[0], near[1] - far[1]));
      }
  }
  return longest;
}

}  // namespace

EpipolarLine::EpipolarLine(const PosedFrame& reference, const PosedFrame& other, const Pinhole& camera) {
  Eigen::Matrix3d k;
  k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  const auto relative = other.pose.inverse() * reference.pose;
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Matrix3d r = Eigen::Map<const RowMajor>(relative.rotation.data());
  Eigen::Map<RowMajor>(at_infinity.data()) = k * r * k.inverse();
  const Vec3 t = relative.translation_m;
  Eigen::Map<Eigen::Vector3d>(per_inverse_depth.data()) = k * Eigen::Vector3d(t.x, t.y, t.z);
}

std::array<double, 3> EpipolarLine::start(int x, int y) const {
  const auto& m = at_infinity;
  return {m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5], m[6] * x + m[7] * y + m[8]};
}

std::array<double, 2> EpipolarLine::place(int x, int y, double inverse_depth) const {
  auto p = start(x, y);
  for (std::size_t i = 0; i < 3; ++i) p[i] += inverse_depth * per_inverse_depth[i];
  return {p[0] / p[2], p[1] / p[2]};
}

PlaneSweep::PlaneSweep(const PosedFrame& reference, std::span<const PosedFrame> others, const Pinhole& camera,
                       const SweptPlanes& planes, const MultiViewOptions& options, const Work& work)
    : reference_(match_view(*reference.picture, luma8(*reference.picture), options.volume.census, work)),
      camera_(camera),
      planes_(planes),
      seen_share_(options.seen_share) {
  for (const PosedFrame& other : others) {
    OtherView view{census_9x7(luma8(*other.picture), work),
                   Raster<std::uint32_t>(camera.width, camera.height),
                   EpipolarLine(reference, other, camera)};
    std::transform(other.picture->values().begin(), other.picture->values().end(),
                   view.colour.values().begin(), packed);
    others_.push_back(std::move(view));
  }
  for (std::size_t i = 0; i < colour_cost_.size(); ++i)
    colour_cost_[i] = saturating_cost(static_cast<double>(i), options.volume.colour_scale);
  for (std::size_t i = 0; i < census_cost_.size(); ++i)
    census_cost_[i] = saturating_cost(static_cast<double>(i), options.volume.census_scale);
  const double steps = std::ceil(longest_line_px(others, reference, camera, planes) / options.step_px) + 1;
  steps_ = static_cast<int>(std::clamp(steps, 16.0, static_cast<double>(options.most_steps)));
}

void PlaneSweep::costs_in(const OtherView& other, int x, int y, std::int32_t* places,
                          std::uint16_t* out) const {
  const auto start = other.line.start(x, y);
  const double first = inverse_depth(x, y, 0), step = inverse_depth(x, y, 1) - first;
  PixelLine line{{}, {}, other.census.width(), other.census.height(), steps_};
  for (std::size_t i = 0; i < 3; ++i) {
    line.start[i] = static_cast<float>(start[i] + first * other.line.per_inverse_depth[i]);
    line.step[i] = static_cast<float>(step * other.line.per_inverse_depth[i]);
  }
  find_places(line, places);
  const std::uint64_t mask = reference_.similar(x, y);
  const Wanted wanted{reference_.census(x, y),   mask,
                      census_scale(mask),        reference_.colour.r(x, y),
                      reference_.colour.g(x, y), reference_.colour.b(x, y)};
  costs_at(places, steps_, wanted, other.census.values().data(), other.colour.values().data(),
           {colour_cost_.data(), census_cost_.data()}, out);
}

void PlaneSweep::fill(CostVolume& volume, const Work& work) const {
  const auto steps = static_cast<std::size_t>(steps_);
  parallel_for(work, volume.height, 4, [&](int begin, int end) {
    std::vector<std::uint16_t> costs(others_.size() * steps);
    std::vector<std::int32_t> places(steps);
    RobustMean mean(others_.size(), steps, seen_share_);
    for (int y = begin; y < end && !work.cancelled(); ++y)
      for (int x = 0; x < volume.width; ++x) {
        for (std::size_t o = 0; o < others_.size(); ++o)
          costs_in(others_[o], x, y, places.data(), costs.data() + o * steps);
        mean(costs.data(), volume.at(x, y));
      }
  });
}

}  // namespace palpable::vision
