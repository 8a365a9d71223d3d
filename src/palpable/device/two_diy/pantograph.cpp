// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/pantograph.hpp"

#include <cmath>

namespace palpable::device {
namespace {

/// The sine of the angle between the outer links below which the linkage counts as stretched or folded.
constexpr double kLeastSine = 0.05;

InPlane elbow(double base_m, double length_m, double angle_rad) {
  return {base_m + length_m * std::cos(angle_rad), length_m * std::sin(angle_rad)};
}

InPlane between(InPlane from, InPlane to) { return {to.x - from.x, to.y - from.y}; }

double dot(InPlane a, InPlane b) { return a.x * b.x + a.y * b.y; }

/// The angle at the base of a triangle whose sides at it are `a` and `b`, opposite of `c`; nullopt if there
/// is none.
std::optional<double> angle_opposite(double c, double a, double b) {
  const double cosine = (a * a + b * b - c * c) / (2.0 * a * b);
  if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
  return std::acos(cosine);
}

}  // namespace

std::optional<InPlane> Pantograph::handle_at(LinkAngles angles) const noexcept {
  const InPlane first = elbow(0.0, inner_m, angles[0]);
  const InPlane second = elbow(base_m, inner_m, angles[1]);
  const InPlane across = between(first, second);
  const double apart = std::hypot(across.x, across.y);
  // Half the angle between the outer links has the sine apart / (2 outer).
  const double sine = apart / (2.0 * outer_m);
  const double cosine = std::sqrt(1.0 - sine * sine);
  if (!(2.0 * sine * cosine >= kLeastSine)) return std::nullopt;
  const double up = std::copysign(outer_m * cosine / apart, across.x);
  return InPlane{0.5 * (first.x + second.x) - up * across.y, 0.5 * (first.y + second.y) + up * across.x};
}

std::optional<LinkAngles> Pantograph::angles_at(InPlane place) const noexcept {
  const double from_first = std::hypot(place.x, place.y);
  const double from_second = std::hypot(place.x - base_m, place.y);
  const auto first = angle_opposite(outer_m, inner_m, from_first);
  const auto second = angle_opposite(outer_m, inner_m, from_second);
  if (!first || !second) return std::nullopt;
  return LinkAngles{std::atan2(place.y, place.x) + *first, std::atan2(place.y, place.x - base_m) - *second};
}

std::optional<std::array<InPlane, 2>> Pantograph::jacobian(LinkAngles angles) const noexcept {
  const auto handle = handle_at(angles);
  if (!handle) return std::nullopt;
  const InPlane first = elbow(0.0, inner_m, angles[0]);
  const InPlane second = elbow(base_m, inner_m, angles[1]);
  // The outer links keep their lengths: (P - A).(dP - dA) = 0 and (P - B).(dP - dB) = 0.
  const InPlane a = between(first, *handle);
  const InPlane b = between(second, *handle);
  const double determinant = a.x * b.y - a.y * b.x;
  const double of_first = dot(a, {-first.y, first.x}) / determinant;
  const double of_second = dot(b, {-second.y, second.x - base_m}) / determinant;
  return std::array{InPlane{of_first * b.y, -of_first * b.x}, InPlane{-of_second * a.y, of_second * a.x}};
}

std::optional<std::array<double, 2>> Pantograph::torques(LinkAngles angles, InPlane force_N) const noexcept {
  const auto moved = jacobian(angles);
  if (!moved) return std::nullopt;
  return std::array{dot((*moved)[0], force_N), dot((*moved)[1], force_N)};
}

}  // namespace palpable::device
