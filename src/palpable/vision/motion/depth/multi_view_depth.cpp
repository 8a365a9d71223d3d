// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/census.hpp"
#include "palpable/vision/image/luma.hpp"
#include "palpable/vision/stereo/cost/least_cost.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"
#include "palpable/vision/stereo/cost/sub_pixel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <Eigen/Dense>

namespace palpable::vision {
namespace {

constexpr std::size_t kMostOthers = 16;

MatchView view_of(const PosedFrame& frame, const VolumeOptions& options, const Work& work) {
  return match_view(*frame.picture, luma8(*frame.picture), options.census, work);
}

// The position of a reference pixel at inverse depth w in another picture: (h + w e) / z, in homogeneous
// coordinates.
struct Epipolar {
  Eigen::Matrix3d at_infinity;
  Eigen::Vector3d per_inverse_depth;

  Epipolar(const PosedFrame& reference, const PosedFrame& other, const Pinhole& camera) {
    Eigen::Matrix3d k;
    k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
    const auto relative = other.pose.inverse() * reference.pose;
    const Eigen::Matrix3d r =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(relative.rotation.data());
    at_infinity = k * r * k.inverse();
    const Vec3 t = relative.translation_m;
    per_inverse_depth = k * Eigen::Vector3d(t.x, t.y, t.z);
  }
  Eigen::Vector3d start(int x, int y) const { return at_infinity * Eigen::Vector3d(x, y, 1); }
  Eigen::Vector2d place(int x, int y, double inverse_depth) const {
    return (start(x, y) + inverse_depth * per_inverse_depth).hnormalized();
  }
};

// Tables of colour and census costs, each at most kCostUnit.
struct CostTables {
  std::array<std::uint16_t, 256> colour;
  std::array<std::uint16_t, 64> census;

  explicit CostTables(const VolumeOptions& options) {
    const auto cost = [](double difference, double scale) {
      return static_cast<std::uint16_t>(std::lround(kCostUnit * (1 - std::exp(-difference / scale))));
    };
    for (std::size_t i = 0; i < colour.size(); ++i)
      colour[i] = cost(static_cast<double>(i), options.colour_scale);
    for (std::size_t i = 0; i < census.size(); ++i)
      census[i] = cost(static_cast<double>(i), options.census_scale);
  }
};

struct Sweep {
  MatchView reference;
  std::vector<MatchView> others;
  std::vector<Epipolar> epipolar;
  CostTables tables;
  DepthSpan span;
  int steps = 0;
  double seen_share = 0.5;

  double inverse_depth(double step) const {
    return 1 / span.far + step / (steps - 1) * (1 / span.near - 1 / span.far);
  }
};

int steps_needed(const Sweep& sweep, const Pinhole& camera, const MultiViewOptions& options) {
  double longest = 0.0;
  for (const Epipolar& line : sweep.epipolar)
    for (const int x : {0, camera.width / 2, camera.width - 1})
      for (const int y : {0, camera.height / 2, camera.height - 1})
        longest = std::max(
            longest, (line.place(x, y, 1 / sweep.span.near) - line.place(x, y, 1 / sweep.span.far)).norm());
  return std::clamp(static_cast<int>(std::ceil(longest / options.step_px)) + 1, 16, options.most_steps);
}

// The costs of a pixel in another picture at each inverse depth; kUnseen outside it.
constexpr std::uint16_t kUnseen = 0xFFFF;
PALPABLE_VECTORIZE void costs_in_other(const Sweep& sweep, std::size_t other, int x, int y,
                                       std::uint16_t* out) {
  const MatchView& there = sweep.others[other];
  const Eigen::Vector3d start =
      sweep.epipolar[other].start(x, y) + sweep.inverse_depth(0) * sweep.epipolar[other].per_inverse_depth;
  const Eigen::Vector3d step =
      (sweep.inverse_depth(1) - sweep.inverse_depth(0)) * sweep.epipolar[other].per_inverse_depth;
  const std::uint64_t census = sweep.reference.census(x, y), mask = sweep.reference.similar(x, y);
  const int scale = census_scale(mask);
  const int r = sweep.reference.colour.r(x, y), g = sweep.reference.colour.g(x, y),
            b = sweep.reference.colour.b(x, y);
  const double right = there.colour.width() - 0.5, bottom = there.colour.height() - 0.5;
  for (int i = 0; i < sweep.steps; ++i) {
    const double z = 1 / (start.z() + i * step.z());
    const double u = (start.x() + i * step.x()) * z, v = (start.y() + i * step.y()) * z;
    if (!(z > 0 && u > -0.5 && v > -0.5 && u < right && v < bottom)) {
      out[i] = kUnseen;
      continue;
    }
    const int ui = static_cast<int>(u + 0.5), vi = static_cast<int>(v + 0.5);
    const int bits =
        std::min(63, std::popcount((census ^ there.census(ui, vi)) & mask) * scale / kCensusScaleUnit);
    const int colour = std::max({std::abs(r - there.colour.r(ui, vi)), std::abs(g - there.colour.g(ui, vi)),
                                 std::abs(b - there.colour.b(ui, vi))});
    out[i] = static_cast<std::uint16_t>(sweep.tables.colour[static_cast<std::size_t>(colour)] +
                                        sweep.tables.census[static_cast<std::size_t>(bits)]);
  }
}

// The mean of the least costs over the counted share of the other pictures.
std::uint16_t robust_mean(std::array<std::uint16_t, kMostOthers>& costs, std::size_t count, double share) {
  const auto end = costs.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(costs.begin(), end);
  const auto seen = static_cast<std::size_t>(std::find(costs.begin(), end, kUnseen) - costs.begin());
  if (seen == 0) return kCostUnit;
  const auto used =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(share * static_cast<double>(seen))));
  unsigned sum = 0;
  for (std::size_t i = 0; i < used; ++i) sum += costs[i];
  return static_cast<std::uint16_t>(sum / used);
}

void fill_volume(const Sweep& sweep, CostVolume& volume, const Work& work) {
  const std::size_t count = sweep.others.size();
  const auto steps = static_cast<std::size_t>(sweep.steps);
  parallel_for(work, volume.height, 4, [&](int begin, int end) {
    std::vector<std::uint16_t> costs(count * steps);
    std::array<std::uint16_t, kMostOthers> at_step{};
    for (int y = begin; y < end && !work.cancelled(); ++y)
      for (int x = 0; x < volume.width; ++x) {
        for (std::size_t o = 0; o < count; ++o) costs_in_other(sweep, o, x, y, costs.data() + o * steps);
        std::uint16_t* out = volume.at(x, y);
        for (std::size_t i = 0; i < steps; ++i) {
          for (std::size_t o = 0; o < count; ++o) at_step[o] = costs[o * steps + i];
          out[i] = robust_mean(at_step, count, sweep.seen_share);
        }
      }
  });
}

}  // namespace

std::vector<Parameter> parameters_of(MultiViewOptions& o) {
  std::vector<Parameter> out{
      {"step_px", &o.step_px, {0.2, 4}, "px", "Movement of a pixel between the depths that are tried"},
      {"most_steps", &o.most_steps, {16, 1024}, "", "Depths that are tried at most"},
      {"seen_share", &o.seen_share, {0.1, 1}, "", "Share of the other frames that count, the best ones"}};
  append_parameters(out, "volume", parameters_of(o.volume));
  append_parameters(out, "sgm", parameters_of(o.sgm));
  return out;
}

Result<DepthMap> multi_view_depth(const PosedFrame& reference, std::span<const PosedFrame> others,
                                  const Pinhole& camera, DepthSpan span, const MultiViewOptions& options,
                                  const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  if (others.empty() || others.size() > kMostOthers || !(span.near > 0 && span.far > span.near))
    return Error{ErrorCode::usage,
                 "multi-view depth needs 1 to 16 other frames and a span of depths",
                 {},
                 Reason::unspecified};
  Sweep sweep{view_of(reference, options.volume, work),
              {},
              {},
              CostTables(options.volume),
              span,
              0,
              options.seen_share};
  for (const PosedFrame& other : others) {
    sweep.others.push_back(view_of(other, options.volume, work));
    sweep.epipolar.emplace_back(reference, other, camera);
  }
  sweep.steps = steps_needed(sweep, camera, options);
  CostVolume volume(camera.width, camera.height, sweep.steps), sums(camera.width, camera.height, sweep.steps);
  fill_volume(sweep, volume, work);
  average_over_crosses(sweep.reference.colour, options.volume.cross, volume, sums, work);
  aggregate_paths(volume, sweep.reference.colour, sweep.reference.colour, options.sgm, sums, work);
  if (work.cancelled()) return Work::interrupted();
  const Raster<float> step = least_cost_disparity(sums, work);
  DepthMap out{Raster<float>(camera.width, camera.height), camera};
  for (std::size_t i = 0; i < step.count(); ++i)
    out.depth_m.values()[i] = static_cast<float>(1 / sweep.inverse_depth(step.values()[i]));
  return out;
}

}  // namespace palpable::vision
