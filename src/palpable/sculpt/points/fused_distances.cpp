// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/fused_distances.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

/// Calls visit(x, y, z) for all voxels except those at the border, in parallel slices.
template <class Visit>
void for_inner(const FusedDistances& fused, const Work& work, const Visit& visit) {
  parallel_for(work, std::max(0, fused.size[0] - 2), 1, [&](int begin, int end) {
    for (int x = begin + 1; x < end + 1 && !work.cancelled(); ++x)
      for (int y = 1; y + 1 < fused.size[1]; ++y)
        for (int z = 1; z + 1 < fused.size[2]; ++z) visit(x, y, z);
  });
}

/// The mean variance around each voxel, since two maps alone are a poor estimate of their noise. If none is
/// known there, the mean over all voxels.
std::vector<float> variance_around(const FusedDistances& fused, const Work& work) {
  double sum = 0.0, count = 0.0;
  for (const float n : fused.variance_m2)
    if (n >= 0.0F) sum += static_cast<double>(n), count += 1.0;
  const auto overall = static_cast<float>(count > 0.0 ? sum / count : 0.0);
  std::vector<float> around(fused.variance_m2.size(), overall);
  for_inner(fused, work, [&](int x, int y, int z) {
    float near = 0.0F;
    int known = 0;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const float n = fused.variance_m2[fused.index(x + dx, y + dy, z + dz)];
          if (n >= 0.0F) near += n, ++known;
        }
    if (known > 0) around[fused.index(x, y, z)] = near / static_cast<float>(known);
  });
  return around;
}

/// One of each two opposite neighbours.
constexpr std::array<std::array<int, 3>, 13> kPairs{{{1, 0, 0},
                                                     {0, 1, 0},
                                                     {0, 0, 1},
                                                     {1, 1, 0},
                                                     {1, -1, 0},
                                                     {1, 0, 1},
                                                     {1, 0, -1},
                                                     {0, 1, 1},
                                                     {0, 1, -1},
                                                     {1, 1, 1},
                                                     {1, 1, -1},
                                                     {1, -1, 1},
                                                     {1, -1, -1}}};

}  // namespace

std::vector<Parameter> parameters_of(SmoothingOptions& o) {
  return {
      {"noise_m", &o.noise_m, {0.0, 1.0}, "m", "standard deviation of a distance; 0 = as the maps disagree"},
      {"passes", &o.passes, {0, 1000}, "", "passes, alternately forward and backward"},
      {"forward", &o.forward, {0.0, 1.0}, "", "share by which a forward pass moves a distance"},
      {"backward", &o.backward, {0.0, 1.0}, "", "share by which a backward pass moves it away"},
      {"explained_deviations",
       &o.explained_deviations,
       {0.0, 100.0},
       "deviations",
       "differences up to this are noise"}};
}

void smooth(FusedDistances& fused, double truncation_m, const SmoothingOptions& options, const Work& work) {
  const auto given = static_cast<float>(options.noise_m * options.noise_m);
  const std::vector<float> variance = options.noise_m > 0.0
                                          ? std::vector<float>(fused.variance_m2.size(), given)
                                          : variance_around(fused, work);
  const auto most = static_cast<float>(truncation_m) * 0.999F;
  const auto forward = static_cast<float>(options.forward), backward = static_cast<float>(options.backward);
  const auto explained = static_cast<float>(options.explained_deviations * options.explained_deviations);
  std::vector<float> next = fused.distance_m;
  for (int pass = 0; pass < options.passes && !work.cancelled(); ++pass) {
    const float step = pass % 2 == 0 ? forward : -backward;
    for_inner(fused, work, [&](int x, int y, int z) {
      const std::size_t here = fused.index(x, y, z);
      const float value = fused.distance_m[here];
      if (std::abs(value) >= most) return;
      float sum = 0.0F;
      int pairs = 0;
      for (const auto& [dx, dy, dz] : kPairs) {
        const float a = fused.distance_m[fused.index(x + dx, y + dy, z + dz)];
        const float b = fused.distance_m[fused.index(x - dx, y - dy, z - dz)];
        if (std::max(std::abs(a), std::abs(b)) >= most) continue;
        sum += 0.5F * (a + b);
        ++pairs;
      }
      if (pairs == 0) return;
      const float off = value - sum / static_cast<float>(pairs);
      const float by_noise = std::min(1.0F, explained * variance[here] / std::max(off * off, 1e-30F));
      next[here] = value - step * by_noise * off;
    });
    std::swap(fused.distance_m, next);
    std::copy(fused.distance_m.begin(), fused.distance_m.end(), next.begin());
  }
}

}  // namespace palpable::sculpt
