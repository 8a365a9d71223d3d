// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/simulated_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::study {
namespace {

/// The position on a minimum-jerk movement from 0 to 1, at time `t` of 0 to 1 (Flash & Hogan 1985).
double minimum_jerk(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

/// The search range for the nearest point of the line, backwards and forwards.
constexpr double kBack_m = 0.002;
constexpr double kAhead_m = 0.006;
/// A corner nearer than this counts as reached: the next submovement passes it.
constexpr double kAtCorner_m = 0.0005;

}  // namespace

SimulatedTracer::SimulatedTracer(std::shared_ptr<const LineByLength> line, const TracerParameters& parameters,
                                 std::uint64_t seed)
    : line_(std::move(line)), p_(parameters), random_(seed), aim_m_(line_->point(0.0)) {}

Vec3 SimulatedTracer::remaining_m() const {
  Vec3 sum;
  for (const Submovement& submovement : submovements_)
    sum += (1.0 - minimum_jerk(submovement.age_s / p_.duration_s)) * submovement.displacement_m;
  return sum;
}

void SimulatedTracer::plan() {
  // The believed position: what was seen one delay ago, plus the movement commanded since.
  Vec3 believed = seen_m_.front() + Vec3{p_.visual_noise_m * gaussian(), p_.visual_noise_m * gaussian(), 0.0};
  for (const Vec3& way : commanded_m_) believed += way;
  const Vec3 end = believed + remaining_m();
  along_m_ = std::max(along_m_, line_->nearest(end, std::max(0.0, along_m_ - kBack_m),
                                               std::min(line_->length_m(), along_m_ + kAhead_m)));
  // A submovement ends at a corner instead of cutting it.
  double ahead_m = p_.speed_m_per_s * p_.interval_s;
  const double corner_m = line_->next_corner(along_m_);
  if (corner_m - along_m_ > kAtCorner_m) ahead_m = std::min(ahead_m, corner_m - along_m_);
  const Vec3 here = line_->point(along_m_);
  const Vec3 way =
      line_->point(std::min(along_m_ + ahead_m, line_->length_m())) - here + p_.correction * (here - end);
  const double noise_m = p_.motor_noise * norm(way);
  submovements_.push_back({way + Vec3{noise_m * gaussian(), noise_m * gaussian(), 0.0}});
}

Vec3 SimulatedTracer::step(Vec3 hand_m, double dt_s) {
  const auto kept = static_cast<std::size_t>(std::max(1.0, p_.delay_s / dt_s));
  seen_m_.push_back(hand_m);
  while (seen_m_.size() > kept) seen_m_.pop_front();
  until_next_s_ -= dt_s;
  if (until_next_s_ <= 0.0 && !finished_) {
    plan();
    until_next_s_ += p_.interval_s;
  }
  Vec3 way;
  for (Submovement& submovement : submovements_) {
    const double before = minimum_jerk(submovement.age_s / p_.duration_s);
    submovement.age_s += dt_s;
    way += (minimum_jerk(submovement.age_s / p_.duration_s) - before) * submovement.displacement_m;
  }
  while (!submovements_.empty() && submovements_.front().age_s >= p_.duration_s) submovements_.pop_front();
  commanded_m_.push_back(way);
  while (commanded_m_.size() > kept) commanded_m_.pop_front();
  aim_m_ += way + std::min(1.0, p_.compliance * dt_s / p_.interval_s) * (hand_m - aim_m_);
  // The end of the line, or the start of a closed one.
  constexpr double kAtEnd_m = 0.0015;
  const double left_m = line_->length_m() - along_m_;
  if (left_m < kAtEnd_m && norm(hand_m - line_->point(line_->length_m())) < kAtEnd_m) finished_ = true;
  if (finished_) submovements_.clear();
  return aim_m_;
}

}  // namespace palpable::study
