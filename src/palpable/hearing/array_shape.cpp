// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/array_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <opencv2/core.hpp>

namespace palpable::hearing {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Extents (standard deviations, metres) along three axes, the greatest first; the axes are rows.
struct PrincipalAxes {
  std::array<double, 3> extent_m{};
  std::array<Vec3, 3> axis;
};

PrincipalAxes principal_axes(const Microphones& microphones) {
  Vec3 mean;
  for (const auto& p : microphones.positions_m) mean += p.v;
  const double count = static_cast<double>(microphones.positions_m.size());
  mean = mean / count;
  cv::Matx33d spread = cv::Matx33d::zeros();
  for (const auto& p : microphones.positions_m) {
    const Vec3 d = p.v - mean;
    const cv::Vec3d column(d.x, d.y, d.z);
    spread += column * column.t() * (1.0 / count);
  }
  cv::Mat values, vectors;
  cv::eigen(spread, values, vectors);
  PrincipalAxes out;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    out.extent_m[at] = std::sqrt(std::max(0.0, values.at<double>(i)));
    out.axis[at] = {vectors.at<double>(i, 0), vectors.at<double>(i, 1), vectors.at<double>(i, 2)};
  }
  return out;
}

Result<double> aperture_of(const Microphones& microphones) {
  constexpr double kNearest_m = 1e-3, kFarthest_m = 10.0;
  const auto& at = microphones.positions_m;
  if (at.size() < 3 || at.size() > 64)
    return invalid_input("has " + std::to_string(at.size()) +
                         " microphones; a direction needs 3 to 64 that are not on a line");
  double aperture_m = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!is_finite(at[i].v) || norm(at[i].v) > kFarthest_m)
      return invalid_input("has a microphone more than 10 m from the origin");
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_m = norm(at[i].v - at[j].v);
      if (apart_m < kNearest_m) return invalid_input("has two microphones less than 1 mm apart");
      aperture_m = std::max(aperture_m, apart_m);
    }
  }
  // Delays must be short beside a spectrum's frame.
  constexpr double kWidest_m = 3.0;
  if (aperture_m > kWidest_m) return invalid_input("has microphones more than 3 m apart");
  return aperture_m;
}

}  // namespace

Result<ArrayGeometry> geometry_of(const Microphones& microphones) {
  const double speed = microphones.speed_of_sound_m_per_s;
  if (!(speed >= 100.0 && speed <= 2000.0))
    return invalid_input("states a speed of sound outside of 100 to 2000 m/s");
  const auto aperture_m = aperture_of(microphones);
  if (!aperture_m) return aperture_m.error();
  // Below this share of the greatest extent, delays along an axis are lost in their errors.
  constexpr double kFlat = 0.1;
  // A normal within 25 degrees of the vertical is a level plane's; within 11 of the side, left and right of
  // such a plane are alike.
  constexpr double kLevel = 0.906, kSideways = 0.2;
  const PrincipalAxes axes = principal_axes(microphones);
  if (axes.extent_m[1] < kFlat * axes.extent_m[0])
    return invalid_input("has all its microphones on a line, which leaves a cone of directions");
  ArrayGeometry out;
  out.aperture_m = *aperture_m;
  if (axes.extent_m[2] >= kFlat * axes.extent_m[0]) return out;
  const Vec3 normal = axes.axis[2];
  out.shape = std::abs(normal.y) >= kLevel ? ArrayShape::level : ArrayShape::upright;
  if (out.shape == ArrayShape::upright && std::abs(normal.z) < kSideways)
    return invalid_input(
        "has its microphones in a plane that runs straight ahead: its two sides are alike, and neither is "
        "taken for the front");
  const bool points_away = out.shape == ArrayShape::level ? normal.y > 0.0 : normal.z < 0.0;
  out.normal = points_away ? -normal : normal;
  return out;
}

Bearing bearing_of(Vector<CameraFrame> direction, ArrayShape shape) {
  const Vec3 d = unit(direction.v);
  Bearing out{std::atan2(d.x, d.z) / kDegree, std::nullopt};
  if (shape != ArrayShape::level) out.elevation_deg = std::asin(std::clamp(-d.y, -1.0, 1.0)) / kDegree;
  return out;
}

Vector<CameraFrame> direction_at(double azimuth_deg, double elevation_deg) {
  const double level = std::cos(kDegree * elevation_deg);
  return {{level * std::sin(kDegree * azimuth_deg), -std::sin(kDegree * elevation_deg),
           level * std::cos(kDegree * azimuth_deg)}};
}

}  // namespace palpable::hearing
