// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/fused_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

/// Calls visit(x, y, z) for all voxels but the outermost, slice by slice on all threads.
template <class Visit>
void for_inner(const FusedNumbers& numbers, const Work& work, const Visit& visit) {
  parallel_for(work, std::max(0, numbers.size[0] - 2), 1, [&](int begin, int end) {
    for (int x = begin + 1; x < end + 1 && !work.cancelled(); ++x)
      for (int y = 1; y + 1 < numbers.size[1]; ++y)
        for (int z = 1; z + 1 < numbers.size[2]; ++z) visit(x, y, z);
  });
}

/// The mean of what is known around each voxel: two maps alone are a poor estimate of their noise. Where
/// nothing is known, the mean over all.
std::vector<float> noise_around(const FusedNumbers& numbers, const Work& work) {
  double sum = 0.0, count = 0.0;
  for (const float n : numbers.noise2_m2)
    if (n >= 0.0F) sum += static_cast<double>(n), count += 1.0;
  const auto overall = static_cast<float>(count > 0.0 ? sum / count : 0.0);
  std::vector<float> around(numbers.noise2_m2.size(), overall);
  for_inner(numbers, work, [&](int x, int y, int z) {
    float near = 0.0F;
    int known = 0;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const float n = numbers.noise2_m2[numbers.index(x + dx, y + dy, z + dz)];
          if (n >= 0.0F) near += n, ++known;
        }
    if (known > 0) around[numbers.index(x, y, z)] = near / static_cast<float>(known);
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

void smooth(FusedNumbers& numbers, double truncation_m, double noise_m, const Work& work) {
  const auto given = static_cast<float>(noise_m * noise_m);
  const std::vector<float> noise2 =
      noise_m > 0.0 ? std::vector<float>(numbers.noise2_m2.size(), given) : noise_around(numbers, work);
  const auto most = static_cast<float>(truncation_m) * 0.999F;
  constexpr int kPasses = 12;
  constexpr float kForth = 0.6F, kBack = -0.63F;
  // Noise goes up to three times its standard deviation.
  constexpr float kExplained = 9.0F;
  std::vector<float> next = numbers.distance_m;
  for (int pass = 0; pass < kPasses && !work.cancelled(); ++pass) {
    const float step = pass % 2 == 0 ? kForth : kBack;
    for_inner(numbers, work, [&](int x, int y, int z) {
      const std::size_t here = numbers.index(x, y, z);
      const float value = numbers.distance_m[here];
      if (std::abs(value) >= most) return;
      float sum = 0.0F;
      int pairs = 0;
      for (const auto& [dx, dy, dz] : kPairs) {
        const float a = numbers.distance_m[numbers.index(x + dx, y + dy, z + dz)];
        const float b = numbers.distance_m[numbers.index(x - dx, y - dy, z - dz)];
        if (std::max(std::abs(a), std::abs(b)) >= most) continue;
        sum += 0.5F * (a + b);
        ++pairs;
      }
      if (pairs == 0) return;
      const float off = value - sum / static_cast<float>(pairs);
      const float by_noise = std::min(1.0F, kExplained * noise2[here] / std::max(off * off, 1e-30F));
      next[here] = value - step * by_noise * off;
    });
    std::swap(numbers.distance_m, next);
    std::copy(numbers.distance_m.begin(), numbers.distance_m.end(), next.begin());
  }
}

}  // namespace palpable::sculpt
