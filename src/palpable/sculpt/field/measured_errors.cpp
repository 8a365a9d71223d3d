// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/measured_errors.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace palpable::sculpt {

models::FieldErrors measured_errors(const std::function<double(Vec3)>& felt, const Box& box,
                                    const DistanceSource& source, const ErrorRange& range, const Work& work) {
  constexpr int kTries = 400000;
  constexpr std::size_t kEnough = 20000;
  std::mt19937_64 random(work.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Vec3 size = box.size_m();
  std::vector<double> errors;
  DistanceSource::Hint hint;
  for (int i = 0; i < kTries && errors.size() < kEnough; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p = box.least_m + Vec3{x * size.x, y * size.y, z * size.z};
    const double felt_m = felt(p);
    if (!(felt_m <= range.outside_m && felt_m >= -range.inside_m)) continue;
    errors.push_back(std::abs(felt_m - source.at(p, hint).distance_m));
  }
  models::FieldErrors result;
  if (errors.empty()) return result;
  std::sort(errors.begin(), errors.end());
  result.p99_m = errors[errors.size() * 99 / 100];
  result.max_m = errors.back();
  return result;
}

}  // namespace palpable::sculpt
