// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/find_pull.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::session {
namespace {

double distance_m(Place a, Place b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace

std::shared_ptr<const models::RouteGuide> FindPull::begin(const models::Scene& scene,
                                                          const device::Traits& device, Place from, Place to,
                                                          double force_N) {
  pulls_ = false;
  if (!device.pushes_back) return nullptr;
  models::RouteGuide guide;
  guide.line_m = {{from.x_m, from.y_m}, {to.x_m, to.y_m}};
  guide.force_N = std::min(force_N, kShareOfDevice * device.max_force_N);
  const Vec3 size = models::size_m(scene);
  const double side_m = std::max(size.x, size.y);
  guide.reach_m = std::clamp(0.08 * side_m, 0.001, 0.05);
  guide.ahead_m = std::clamp(0.03 * side_m, 0.0005, 0.02);
  if (!models::is_valid(guide)) return nullptr;
  pulls_ = true;
  to_ = to;
  least_m_ = distance_m(from, to);
  return std::make_shared<const models::RouteGuide>(std::move(guide));
}

bool FindPull::is_pushed_away(const models::Scene& scene, Place from) {
  if (!pulls_) return false;
  const Vec3 size = models::size_m(scene);
  const double now_m = distance_m(from, to_);
  least_m_ = std::min(least_m_, now_m);
  return now_m > least_m_ + kPushedAway * std::max(size.x, size.y);
}

}  // namespace palpable::session
