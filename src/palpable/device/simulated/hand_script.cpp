// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/hand_script.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::device {
namespace {

/// Speed towards a surface at an unknown height, and away from it.
constexpr double kApproach_m_per_s = 0.08;
constexpr double kLift_m_per_s = 0.10;
constexpr double kLift_s = 0.12;
/// Force at which the hand notices the surface.
constexpr double kNoticed_N = 0.15;
/// Speed at which the hand moves deeper, per newton of missing contact force.
constexpr double kYield_m_per_Ns = 0.05;
constexpr double kYield_m_per_s = 0.04;
/// Excess over the intended contact force that stops a stroke.
constexpr double kStopped_N = 1.0;
/// The part of the workspace that is explored.
constexpr double kVisited = 0.46;
/// Height above a known surface at which the hand begins to move down slowly.
constexpr double kAbove_m = 0.002;
/// Time of a stroke along the floor, or off a known surface, without contact after which the hand continues
/// elsewhere.
constexpr double kEmpty_s = 0.6;
/// Its speed on the way there, in free air.
constexpr double kTravel_m_per_s = 0.15;
/// Each such failure reduces the explored width and height to this fraction.
constexpr double kNearer = 0.5;
constexpr double kLeastPart = 0.1;

/// Two sines of incommensurable frequencies: the curve covers the plane coarsely at first and ever more
/// densely later. `along` is the curve's parameter.
Vec3 curve_at(double along, Vec3 workspace_m) {
  return {kVisited * workspace_m.x * std::sin(2.0 * along),
          kVisited * workspace_m.y * std::sin(2.0 * along / std::numbers::phi + 1.0), 0.0};
}

}  // namespace

HandScript::HandScript(const HandScriptOptions& options) : options_(options), random_(options.seed) {
  goal_m_ = {0.0, 0.0, options.deep ? 0.5 * options.workspace_m.z : 0.0};
  target_m_ = goal_m_;
  along_m_ = uniform(0.0, 1.0);
  crossing_m_ = 0.5 * options.workspace_m.z;
  if (has_strokes()) {
    double highest_m = -crossing_m_;
    for (const auto& stroke : options_.strokes) {
      PALPABLE_CHECK(stroke.size() >= 2);
      for (const auto& point : stroke) highest_m = std::max(highest_m, point.v.z);
    }
    crossing_m_ = std::min(crossing_m_, highest_m + kAbove_m);
    choose_stroke(static_cast<std::size_t>(options.seed % options_.strokes.size()));
    goal_m_ = target_m_;
  } else if (options.kind == HandScriptOptions::Kind::scan) {
    const Vec3 place = curve_at(along_m_, options.workspace_m);
    goal_m_ = {place.x, place.y, goal_m_.z};
  }
  begin(options.deep ? Phase::approach : Phase::stroke);
}

double HandScript::uniform(double least, double most) noexcept {
  // Not std::uniform_real_distribution, whose numbers differ between standard libraries.
  return least + (most - least) * (static_cast<double>(random_() >> 11) * 0x1.0p-53);
}

void HandScript::begin(Phase phase) noexcept {
  phase_ = phase;
  phase_s_ = 0.0;
  empty_s_ = 0.0;
  if (phase == Phase::stroke) stroke_s_ = uniform(2.0, 5.0);
}

bool HandScript::has_strokes() const noexcept {
  return options_.deep && options_.kind == HandScriptOptions::Kind::scan && !options_.strokes.empty();
}

Vec3 HandScript::step(Vec3 hand_m, Vec3 force_N, double dt_s) noexcept {
  if (options_.kind == HandScriptOptions::Kind::hold) return goal_m_;
  phase_s_ += dt_s;
  const double floor_m = -0.5 * options_.workspace_m.z;
  const double ceiling_m = -floor_m;
  switch (phase_) {
    case Phase::approach:
      goal_m_.z = std::max(goal_m_.z - kApproach_m_per_s * dt_s, floor_m);
      if (force_N.z > kNoticed_N || hand_m.z <= 0.98 * floor_m) begin(Phase::stroke);
      break;
    case Phase::stroke:
      stroke_along(dt_s, force_N);
      if (!options_.deep) break;
      // The magnitude of the force counts, whatever its direction: a hand that meets a wall rises until it
      // passes over it.
      goal_m_.z -= dt_s * std::clamp(kYield_m_per_Ns * (options_.press_N - norm(force_N)), -kYield_m_per_s,
                                     kYield_m_per_s);
      goal_m_.z = std::clamp(goal_m_.z, floor_m, ceiling_m);
      note_contact(force_N, dt_s);
      if (empty_s_ > kEmpty_s || (has_strokes() && phase_s_ > stroke_s_)) {
        choose_elsewhere();
        begin(Phase::travel);
      } else if (phase_s_ > stroke_s_) {
        begin(Phase::lift);
      }
      break;
    case Phase::lift:
      stroke_along(dt_s, force_N);
      // The desired position moves at the arm's speed: starting from the pressed depth, it takes some time to
      // lift off.
      goal_m_.z = std::min(goal_m_.z + kLift_m_per_s * dt_s, ceiling_m);
      if (norm(force_N) > kNoticed_N) phase_s_ = 0.0;
      if (phase_s_ > kLift_s) begin(Phase::approach);
      break;
    case Phase::travel:
      travel(dt_s);
      break;
  }
  return goal_m_;
}

void HandScript::stroke_along(double dt_s, Vec3 force_N) noexcept {
  const double half_width = kVisited * options_.workspace_m.x;
  const double half_height = kVisited * options_.workspace_m.y;
  // The hand does not advance against resistance; it waits until it can pass.
  const double excess_N = norm(force_N) - options_.press_N;
  const double ease = options_.deep ? std::clamp(1.0 - excess_N / kStopped_N, 0.05, 1.0) : 1.0;
  const double step_m = ease * options_.speed_m_per_s * dt_s;
  if (has_strokes()) {
    follow_stroke(step_m);
    return;
  }
  if (options_.kind == HandScriptOptions::Kind::scan) {
    follow_curve(step_m);
    return;
  }
  const Vec3 way{target_m_.x - goal_m_.x, target_m_.y - goal_m_.y, 0.0};
  if (norm(way) <= 2.0 * step_m) {
    target_m_.x = uniform(-half_width, half_width);
    target_m_.y = uniform(-half_height, half_height);
    return;
  }
  goal_m_ += step_m * unit(way);
}

void HandScript::follow_curve(double step_m) noexcept {
  along_m_ += step_m / (2.0 * kVisited * std::max(options_.workspace_m.x, options_.workspace_m.y));
  const Vec3 place = curve_at(along_m_, options_.workspace_m);
  goal_m_ = {place.x, place.y, goal_m_.z};
}

/// The desired position moves as the point on the polyline does, there and back, also up and down; the force
/// adds to its height.
void HandScript::follow_stroke(double step_m) noexcept {
  const auto& stroke = options_.strokes[stroke_];
  const Vec3 way = stroke[next_point_].v - on_stroke_m_;
  const bool arrives = norm(way) <= step_m;
  const Vec3 moved = arrives ? way : step_m * unit(way);
  on_stroke_m_ += moved;
  goal_m_ += moved;
  if (!arrives) return;
  if (next_point_ == 0) is_returning_ = false;
  if (next_point_ + 1 == stroke.size()) is_returning_ = true;
  next_point_ = is_returning_ ? next_point_ - 1 : next_point_ + 1;
}

/// Its first point becomes the target.
void HandScript::choose_stroke(std::size_t stroke) noexcept {
  stroke_ = stroke;
  next_point_ = 1;
  is_returning_ = false;
  on_stroke_m_ = options_.strokes[stroke].front().v;
  target_m_ = on_stroke_m_;
  target_m_.z = std::min(target_m_.z + kAbove_m, 0.5 * options_.workspace_m.z);
}

void HandScript::choose_elsewhere() noexcept {
  if (has_strokes())
    choose_stroke((stroke_ + 1) % options_.strokes.size());
  else
    choose_nearer_middle();
}

void HandScript::note_contact(Vec3 force_N, double dt_s) noexcept {
  if (norm(force_N) > kNoticed_N) {
    empty_s_ = 0.0;
    visited_part_ = 1.0;
  } else if (has_strokes() || goal_m_.z <= -0.5 * options_.workspace_m.z) {
    empty_s_ += dt_s;
  }
}

void HandScript::choose_nearer_middle() noexcept {
  visited_part_ = std::max(kNearer * visited_part_, kLeastPart);
  const double half_width = kVisited * visited_part_ * options_.workspace_m.x;
  const double half_height = kVisited * visited_part_ * options_.workspace_m.y;
  if (options_.kind == HandScriptOptions::Kind::random) {
    target_m_ = {uniform(-half_width, half_width), uniform(-half_height, half_height), 0.0};
    return;
  }
  // The next part of the curve that lies there; the stroke continues from it.
  constexpr double kStep = 0.02;
  constexpr int kMostSteps = 1000;
  for (int i = 0; i < kMostSteps; ++i) {
    along_m_ += kStep;
    target_m_ = curve_at(along_m_, options_.workspace_m);
    if (std::abs(target_m_.x) <= half_width && std::abs(target_m_.y) <= half_height) return;
  }
}

/// Up first, then across, then down: above a known surface at the same speed, else slowly.
void HandScript::travel(double dt_s) noexcept {
  const double step_m = kTravel_m_per_s * dt_s;
  const bool is_above = goal_m_.x == target_m_.x && goal_m_.y == target_m_.y;
  if (!is_above && goal_m_.z < crossing_m_) {
    goal_m_.z = std::min(goal_m_.z + step_m, crossing_m_);
    return;
  }
  const Vec3 way{target_m_.x - goal_m_.x, target_m_.y - goal_m_.y, 0.0};
  if (norm(way) > step_m) {
    goal_m_ += step_m * unit(way);
    return;
  }
  goal_m_ = {target_m_.x, target_m_.y, goal_m_.z};
  if (has_strokes() && goal_m_.z > target_m_.z)
    goal_m_.z = std::max(goal_m_.z - step_m, target_m_.z);
  else
    begin(Phase::approach);
}

}  // namespace palpable::device
