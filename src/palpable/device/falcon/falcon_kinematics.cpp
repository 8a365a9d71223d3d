// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_kinematics.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace palpable::device::falcon {
namespace {

// Lengths in metres, named as in the paper: a the arm, b the parallelogram's long side, c half the grip's
// width, d = e the ends of the parallelogram, f the side offset, r and s the arm's axis in the base.
constexpr double kA = 0.060, kB = 0.1025, kC = 0.01443, kD = 0.01125, kF = -0.025, kR = 0.040, kS = -0.02309;
constexpr std::array<double, 3> kLeg_deg{105.0, -15.0, -135.0};

struct Turn {
  double cosine;
  double sine;
};

const std::array<Turn, 3>& legs() noexcept {
  static const std::array<Turn, 3> turns = [] {
    std::array<Turn, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double phi = kLeg_deg[k] * std::numbers::pi / 180.0;
      out[k] = {std::cos(phi), std::sin(phi)};
    }
    return out;
  }();
  return turns;
}

/// A place in a leg's own frame: u away from the middle, v along the arm's axis, w out of the base.
Vec3 in_leg(const Turn& leg, Vec3 place_m) noexcept {
  return {leg.cosine * place_m.x + leg.sine * place_m.y - kR,
          -leg.sine * place_m.x + leg.cosine * place_m.y - kS, place_m.z};
}

Vec3 out_of_leg(const Turn& leg, Vec3 v) noexcept {
  return {leg.cosine * v.x - leg.sine * v.y, leg.sine * v.x + leg.cosine * v.y, v.z};
}

/// The equation of one leg, zero where the parallelogram joins arm and grip, with its derivatives.
struct Closure {
  double value;
  Vec3 by_place;
  double by_angle;
};

std::optional<Closure> closure(const Turn& leg, Vec3 place_m, double angle) noexcept {
  const Vec3 p = in_leg(leg, place_m);
  const double cosine3 = (p.y + kF) / kB;
  const double squared = 1.0 - cosine3 * cosine3;
  if (!(squared > 0.0)) return {};
  const double sine3 = std::sqrt(squared);
  const double along = p.x + kC - kA * std::cos(angle);
  const double out = p.z - kA * std::sin(angle);
  const double reach = 2.0 * kD + kB * sine3;
  // d(reach)/dv = -cot(theta3).
  const Vec3 by_leg{2.0 * along, 2.0 * reach * cosine3 / sine3, 2.0 * out};
  return Closure{along * along + out * out - reach * reach, out_of_leg(leg, by_leg),
                 2.0 * kA * (along * std::sin(angle) - out * std::cos(angle))};
}

struct Closures {
  std::array<double, 3> value;
  std::array<Vec3, 3> by_place;
  std::array<double, 3> by_angle;
};

std::optional<Closures> closures(const ArmAngles& angles, Vec3 place_m) noexcept {
  Closures all{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto one = closure(legs()[k], place_m, angles[k]);
    if (!one) return {};
    all.value[k] = one->value;
    all.by_place[k] = one->by_place;
    all.by_angle[k] = one->by_angle;
  }
  return all;
}

/// The columns of the inverse of the matrix with these rows. nullopt if it is nearly singular: the legs'
/// directions span less than a hundredth of a cube.
std::optional<std::array<Vec3, 3>> inverse(const std::array<Vec3, 3>& rows) noexcept {
  constexpr double kFlattest = 0.01;
  const double determinant = dot(rows[0], cross(rows[1], rows[2]));
  const double sizes = norm(rows[0]) * norm(rows[1]) * norm(rows[2]);
  if (!(std::abs(determinant) > kFlattest * sizes)) return {};
  return std::array{cross(rows[1], rows[2]) / determinant, cross(rows[2], rows[0]) / determinant,
                    cross(rows[0], rows[1]) / determinant};
}

}  // namespace

std::optional<ArmAngles> angles_at(Vec3 place_m) noexcept {
  ArmAngles angles{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = in_leg(legs()[k], place_m);
    const double cosine3 = (p.y + kF) / kB;
    const double squared = 1.0 - cosine3 * cosine3;
    if (!(squared > 0.0)) return {};
    const double reach = 2.0 * kD + kB * std::sqrt(squared);
    const double along = p.x + kC;
    const double distance_squared = along * along + p.z * p.z;
    const double cosine =
        (distance_squared + kA * kA - reach * reach) / (2.0 * kA * std::sqrt(distance_squared));
    if (!(std::abs(cosine) < 1.0)) return {};
    angles[k] = std::atan2(p.z, along) - std::acos(cosine);
  }
  return angles;
}

namespace {

/// Whether these are the angles with the elbows outside at a place: other solutions are of no real Falcon.
bool belong(const ArmAngles& angles, Vec3 place_m) noexcept {
  constexpr double kSame_rad = 1e-6;
  const auto outside = angles_at(place_m);
  if (!outside) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::abs((*outside)[k] - angles[k]) < kSame_rad)) return false;
  return true;
}

}  // namespace

std::optional<Vec3> place_of(const ArmAngles& angles, Vec3 near_m) noexcept {
  constexpr int kMostSteps = 20;
  constexpr double kClose_m = 1e-9;
  // No step leaves the region in which Newton's method is known to come nearer.
  constexpr double kLongestStep_m = 0.03;
  Vec3 place = near_m;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto all = closures(angles, place);
    const auto inverted = all ? inverse(all->by_place) : std::nullopt;
    if (!inverted) return {};
    Vec3 move =
        -(all->value[0] * (*inverted)[0] + all->value[1] * (*inverted)[1] + all->value[2] * (*inverted)[2]);
    const double length = norm(move);
    if (!std::isfinite(length)) return {};
    if (length > kLongestStep_m) move *= kLongestStep_m / length;
    place += move;
    if (length >= kClose_m) continue;
    return belong(angles, place) ? std::optional(place) : std::nullopt;
  }
  return {};
}

std::optional<std::array<Vec3, 3>> jacobian(const ArmAngles& angles, Vec3 place_m) noexcept {
  const auto all = closures(angles, place_m);
  const auto inverted = all ? inverse(all->by_place) : std::nullopt;
  if (!inverted) return {};
  return std::array{-all->by_angle[0] * (*inverted)[0], -all->by_angle[1] * (*inverted)[1],
                    -all->by_angle[2] * (*inverted)[2]};
}

std::optional<std::array<double, 3>> torques(const ArmAngles& angles, Vec3 place_m, Vec3 force_N) noexcept {
  const auto moved = jacobian(angles, place_m);
  if (!moved) return {};
  return std::array{dot((*moved)[0], force_N), dot((*moved)[1], force_N), dot((*moved)[2], force_N)};
}

}  // namespace palpable::device::falcon
