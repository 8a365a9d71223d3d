// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/head_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace palpable::vision {
namespace {

/// The part of half the height below the middle that belongs to the head; then chin and neck follow.
constexpr double kChin = 0.62;
constexpr double kLeastSize = 0.7, kMostSize = 1.35;

/// A pixel's ray and its reading (NaN if unknown).
struct Reading {
  Vec3 ray;
  double z_m = 0.0;
};

/// The readings of a window around the head, at most about 4000 of them.
std::vector<Reading> readings_around(const Raster<float>& depth_m, const DownwardCamera& camera, Vec3 middle,
                                     double reach_m) {
  constexpr double kAround_m = 0.13, kMostAcross = 64.0;
  const double nearest_m = std::max(0.1, middle.z - reach_m);
  const double across_px = camera.pinhole.fx * (kAround_m + reach_m) / nearest_m;
  const double up_px = camera.pinhole.fy * (kAround_m + reach_m) / nearest_m;
  const int step = std::max(1, static_cast<int>(std::ceil(2.0 * across_px / kMostAcross)));
  const auto [u, v, ahead] = camera.pixel(middle);
  if (!(ahead > 0.0)) return {};
  const auto bound = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, size - 1.0)); };
  std::vector<Reading> readings;
  for (int y = bound(v - up_px, depth_m.height()); y <= bound(v + up_px, depth_m.height()); y += step)
    for (int x = bound(u - across_px, depth_m.width()); x <= bound(u + across_px, depth_m.width()); x += step)
      readings.push_back({camera.ray(x, y), static_cast<double>(depth_m(x, y))});
  return readings;
}

/// Distance of a point from the ellipsoid, to first order, and its derivatives: by the middle's coordinates
/// and by the size.
struct Miss {
  double distance_m = 0.0;
  Eigen::Vector4d slope;
};
Miss miss_of(Vec3 from_middle, double size, Vec3 half_m) {
  const Vec3& q = from_middle;
  const Vec3 g{q.x / (half_m.x * half_m.x), q.y / (half_m.y * half_m.y), q.z / (half_m.z * half_m.z)};
  const double n = std::sqrt(std::max(1e-12, dot(q, g)));
  const double steepness = std::max(1e-9, norm(g) / n);
  Miss miss;
  miss.distance_m = (n - size) / steepness;
  const Vec3 out = g / (n * steepness);
  miss.slope << -out.x, -out.y, -out.z, -1.0 / steepness;
  return miss;
}

struct Sums {
  Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double weight = 0.0;
};

Sums sums_of(const std::vector<Reading>& readings, const HeadFit& fit, double bound_m,
             const HeadShape& shape) {
  Sums sums;
  for (const Reading& reading : readings) {
    if (!std::isfinite(reading.z_m)) continue;
    const Vec3 p = reading.z_m * reading.ray;
    const Vec3 q = p - fit.middle.v;
    if (q.y > kChin * fit.size * shape.half_m.y) continue;
    const Miss miss = miss_of(q, fit.size, shape.half_m);
    const double share = miss.distance_m / bound_m;
    if (!(std::abs(share) < 1.0)) continue;
    // Tukey's weight; far readings have larger pixels.
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    sums.square += weight * miss.slope * miss.slope.transpose();
    sums.right -= weight * miss.distance_m * miss.slope;
    sums.weight += weight;
  }
  return sums;
}

/// Root mean square distance of points from the plane z = a + b x + c y that is nearest to them.
double rms_of_plane(const std::vector<Vec3>& points) {
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const Vec3 origin = points.empty() ? Vec3{} : points.front();
  for (const Vec3& p : points) {
    const Eigen::Vector3d row(1.0, p.x - origin.x, p.y - origin.y);
    square += row * row.transpose();
    right += (p.z - origin.z) * row;
  }
  const Eigen::Vector3d plane = square.ldlt().solve(right);
  const double along = std::sqrt(1.0 + plane(1) * plane(1) + plane(2) * plane(2));
  double squares = 0.0;
  for (const Vec3& p : points) {
    const double off =
        plane(0) + plane(1) * (p.x - origin.x) + plane(2) * (p.y - origin.y) - (p.z - origin.z);
    squares += off * off / (along * along);
  }
  return std::sqrt(squares / std::max(1.0, static_cast<double>(points.size())));
}

/// How well what should be seen of the head is on the ellipsoid.
void judge(const std::vector<Reading>& readings, double bound_m, const HeadShape& shape, HeadFit& fit) {
  double expected = 0.0, unknown = 0.0, squares = 0.0;
  std::vector<Vec3> on_it;
  const Vec3& middle = fit.middle.v;
  for (const Reading& reading : readings) {
    const double x = (reading.ray.x / reading.ray.z * middle.z - middle.x) / (fit.size * shape.half_m.x);
    const double y = (reading.ray.y / reading.ray.z * middle.z - middle.y) / (fit.size * shape.half_m.y);
    if (x * x + y * y > 1.0 || y > kChin) continue;
    expected += 1.0;
    if (!std::isfinite(reading.z_m)) {
      unknown += 1.0;
      continue;
    }
    const Vec3 p = reading.z_m * reading.ray;
    const double off_m = miss_of(p - middle, fit.size, shape.half_m).distance_m;
    if (std::abs(off_m) >= bound_m) continue;
    on_it.push_back(p);
    squares += off_m * off_m;
  }
  const auto count = static_cast<double>(on_it.size());
  fit.covered = (count + 0.5 * unknown) / std::max(1.0, expected);
  fit.rms_m = std::sqrt(squares / std::max(1.0, count));
  fit.rms_of_plane_m = rms_of_plane(on_it);
}

}  // namespace

Vec3 DownwardCamera::ray(double u, double v) const {
  const double x = (u - pinhole.cx) / pinhole.fx, y = (v - pinhole.cy) / pinhole.fy;
  const double c = std::cos(down_rad), s = std::sin(down_rad);
  return {x, c * y + s, c - s * y};
}

Vec3 DownwardCamera::pixel(Vec3 place) const {
  const double c = std::cos(down_rad), s = std::sin(down_rad);
  const double y = c * place.y - s * place.z, z = s * place.y + c * place.z;
  return {pinhole.cx + pinhole.fx * place.x / z, pinhole.cy + pinhole.fy * y / z, z};
}

std::optional<HeadFit> fit_head(const Raster<float>& depth_m, const DownwardCamera& camera,
                                Point<LevelFrame> middle, double reach_m, const HeadShape& shape) {
  constexpr int kSteps = 12;
  constexpr double kLastBound_m = 0.02, kShrink = 0.75, kLeastWeight = 20.0;
  // How much a size other than the average one counts, as m per unit and per reading.
  constexpr double kUsualSize_m = 0.02;
  const auto readings = readings_around(depth_m, camera, middle.v, reach_m);
  HeadFit fit;
  fit.middle = middle;
  double bound_m = std::max(reach_m, kLastBound_m);
  for (int step = 0; step < kSteps; ++step, bound_m = std::max(kLastBound_m, kShrink * bound_m)) {
    Sums sums = sums_of(readings, fit, bound_m, shape);
    if (sums.weight < kLeastWeight) return std::nullopt;
    const double usual = sums.weight * kUsualSize_m * kUsualSize_m;
    sums.square(3, 3) += usual;
    sums.right(3) += usual * (1.0 - fit.size);
    const Eigen::Vector4d by = sums.square.ldlt().solve(sums.right);
    if (!by.allFinite()) return std::nullopt;
    fit.middle.v += Vec3{by(0), by(1), by(2)};
    fit.size = std::clamp(fit.size + by(3), kLeastSize, kMostSize);
    if (norm(fit.middle - middle) > 2.0 * reach_m || !(fit.middle.v.z > 0.0)) return std::nullopt;
  }
  judge(readings, kLastBound_m, shape, fit);
  return fit;
}

}  // namespace palpable::vision
