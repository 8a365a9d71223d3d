// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/smooth_depth.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::vision {
namespace {

/// The plane z + x dx + y dy around a pixel, and the standard deviation of z.
struct DepthPlane {
  float z = kUnknownDepth, by_x = 0.0F, by_y = 0.0F, deviation_m = 0.0F;
};

/// Weighted sums over a window, for the plane with the least squares.
class PlaneSums {
 public:
  void add(double x, double y, double z, double weight) {
    const double wx = weight * x, wy = weight * y;
    w_ += weight, ww_ += weight * weight;
    x_ += wx, y_ += wy, z_ += weight * z;
    xx_ += wx * x, xy_ += wx * y, yy_ += wy * y;
    xz_ += wx * z, yz_ += wy * z, zz_ += weight * z * z;
  }
  double weight() const { return w_; }
  /// The standard deviation of a mean of readings that deviate by 1.
  double deviation() const { return std::sqrt(ww_) / w_; }

  /// The plane in coordinates around the window's middle; level where the pixels lie on one line.
  DepthPlane plane() const {
    const double mx = x_ / w_, my = y_ / w_, mz = z_ / w_;
    const double xx = xx_ / w_ - mx * mx, yy = yy_ / w_ - my * my, xy = xy_ / w_ - mx * my;
    const double xz = xz_ / w_ - mx * mz, yz = yz_ / w_ - my * mz;
    const double determinant = xx * yy - xy * xy;
    constexpr double kLine = 0.05;
    if (determinant < kLine) return {static_cast<float>(mz), 0.0F, 0.0F, 0.0F};
    const double by_x = (xz * yy - yz * xy) / determinant, by_y = (yz * xx - xz * xy) / determinant;
    return {static_cast<float>(mz - by_x * mx - by_y * my), static_cast<float>(by_x),
            static_cast<float>(by_y), 0.0F};
  }
  /// Root mean square distance of the readings from that plane.
  double misfit() const {
    const DepthPlane p = plane();
    const double c = static_cast<double>(p.z), a = static_cast<double>(p.by_x),
                 b = static_cast<double>(p.by_y);
    const double squares = zz_ + c * c * w_ + a * a * xx_ + b * b * yy_ +
                           2.0 * (c * a * x_ + c * b * y_ + a * b * xy_ - c * z_ - a * xz_ - b * yz_);
    return std::sqrt(std::max(squares, 0.0) / w_);
  }

 private:
  double w_ = 0.0, ww_ = 0.0, x_ = 0.0, y_ = 0.0, z_ = 0.0;
  double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0, xz_ = 0.0, yz_ = 0.0, zz_ = 0.0;
};

/// Calls visit(x, y, reading) for the known pixels within `radius`, each `step` pixels.
template <class Visit>
void each_around(const Raster<float>& depth_m, Pixel at, int radius, int step, Visit&& visit) {
  const auto first = [&](int middle) { return middle - std::min(radius, middle) / step * step; };
  const int right = std::min(depth_m.width() - 1, at.x + radius),
            bottom = std::min(depth_m.height() - 1, at.y + radius);
  for (int y = first(at.y); y <= bottom; y += step)
    for (int x = first(at.x); x <= right; x += step)
      if (std::isfinite(depth_m(x, y))) visit(x, y, depth_m(x, y));
}

class Smoother {
 public:
  Smoother(const Raster<float>& depth_m, const DepthNoise& noise, const SmoothDepthOptions& options,
           const Work& work)
      : given_m_(depth_m), kept_m_(depth_m), noise_(noise), options_(options), work_(work) {}

  std::size_t remove_flying() {
    std::size_t removed = 0;
    for (int y = 0; y < given_m_.height(); ++y)
      for (int x = 0; x < given_m_.width(); ++x) {
        if (!std::isfinite(given_m_(x, y)) || is_on_surface({x, y})) continue;
        kept_m_(x, y) = kUnknownDepth;
        ++removed;
      }
    return removed;
  }

  Result<Raster<float>> smoothed() {
    planes_ = Raster<DepthPlane>(kept_m_.width(), kept_m_.height());
    for (std::size_t i = 0; i < kept_m_.count(); ++i) {
      const float z = kept_m_.values()[i];
      planes_.values()[i] = {z, 0.0F, 0.0F, std::isfinite(z) ? noise_.deviation_m(z) : 0.0F};
    }
    settled_ = Raster<std::uint8_t>(kept_m_.width(), kept_m_.height(), 0);
    double radius = 2.0;
    for (int k = 0; k < options_.windows; ++k, radius *= options_.growth) {
      grow_windows(static_cast<int>(std::lround(radius)));
      if (work_.cancelled()) return Work::interrupted();
    }
    Raster<float> out(kept_m_.width(), kept_m_.height());
    std::transform(planes_.values().begin(), planes_.values().end(), out.values().begin(),
                   [](const DepthPlane& plane) { return plane.z; });
    settle_flying(out);
    return out;
  }

 private:
  /// Whether enough of the readings around share its surface: as deep as it is or, on a slope, as much before
  /// it as the reading on the other side is behind it.
  bool is_on_surface(Pixel at) const {
    const float z = given_m_(at.x, at.y);
    const float apart_m = static_cast<float>(options_.band) * noise_.deviation_m(z);
    const auto reading = [&](int x, int y) {
      const bool inside = x >= 0 && y >= 0 && x < given_m_.width() && y < given_m_.height();
      return inside ? given_m_(x, y) : kUnknownDepth;
    };
    int support = -1, known = -1;
    each_around(given_m_, at, 2, 1, [&](int x, int y, float other) {
      ++known;
      const float opposite = reading(2 * at.x - x, 2 * at.y - y);
      // False for an unknown reading.
      if (std::abs(other - z) <= apart_m || std::abs(0.5F * (other + opposite) - z) <= apart_m) ++support;
    });
    // Beside holes there are fewer neighbours.
    return support >= options_.least_support || 2 * support > known;
  }

  void grow_windows(int radius) {
    Raster<DepthPlane> next = planes_;
    parallel_for(work_, kept_m_.height(), 8, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < kept_m_.width(); ++x) grow_window({x, y}, radius, next(x, y));
    });
    planes_ = std::move(next);
  }

  void grow_window(Pixel at, int radius, DepthPlane& out) {
    const DepthPlane before = planes_(at.x, at.y);
    std::uint8_t& settled = settled_(at.x, at.y);
    if (!std::isfinite(before.z) || settled != 0) return;
    // A large window needs only some of its readings.
    const int step = std::max(1, radius / 4);
    const float deviation_m = noise_.deviation_m(before.z);
    const auto band_m = static_cast<float>(options_.band) * std::hypot(deviation_m, before.deviation_m);
    PlaneSums sums;
    each_around(kept_m_, at, radius, step, [&](int x, int y, float z) {
      const auto dx = static_cast<float>(x - at.x), dy = static_cast<float>(y - at.y);
      const float off = (z - before.z - before.by_x * dx - before.by_y * dy) / band_m;
      const float inside = 1.0F - off * off;
      if (inside <= 0.0F) return;
      sums.add(static_cast<double>(dx), static_cast<double>(dy), static_cast<double>(z - before.z),
               static_cast<double>(inside * inside));
    });
    constexpr double kFewest = 4.0;
    if (sums.weight() < kFewest) return;
    DepthPlane plane = sums.plane();
    plane.deviation_m = deviation_m * static_cast<float>(sums.deviation());
    if (std::abs(plane.z) > static_cast<float>(options_.agreement) * before.deviation_m) {
      settled = 1;
      return;
    }
    plane.z += before.z;
    out = plane;
  }

  /// A flying pixel takes the depth of the neighbour that is nearest to its own reading.
  void settle_flying(Raster<float>& out) const {
    const Raster<float> surfaces_m = out;
    for (int y = 0; y < out.height(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        const float z = given_m_(x, y);
        if (!std::isfinite(z) || std::isfinite(out(x, y))) continue;
        each_around(surfaces_m, {x, y}, 2, 1, [&](int, int, float other) {
          if (!(std::abs(out(x, y) - z) <= std::abs(other - z))) out(x, y) = other;
        });
      }
  }

  const Raster<float>& given_m_;
  Raster<float> kept_m_;
  DepthNoise noise_;
  const SmoothDepthOptions& options_;
  const Work& work_;
  Raster<DepthPlane> planes_;
  Raster<std::uint8_t> settled_;
};

}  // namespace

std::vector<Parameter> parameters_of(SmoothDepthOptions& o) {
  return {{"floor_m", &o.noise.floor_m, {0.0, 0.1}, "m", "standard deviation of a reading at depth 0"},
          {"per_m2", &o.noise.per_m2, {0.0, 0.1}, "1/m", "its growth with the square of depth"},
          {"least_level", &o.least_level, {0.0, 100.0}, "", "noise over the model's that is smoothed"},
          {"most_level",
           &o.most_level,
           {0.0, 100.0},
           "",
           "noise over the model's that is none; 0 = nothing is smoothed"},
          {"windows", &o.windows, {1, 8}, "", "number of windows of growing size"},
          {"growth", &o.growth, {1.1, 4.0}, "", "growth from window to window"},
          {"band", &o.band, {1.0, 10.0}, "deviations", "readings within it are on one plane"},
          {"agreement", &o.agreement, {0.0, 10.0}, "deviations", "agreement of larger and smaller windows"},
          {"least_support", &o.least_support, {0, 24}, "", "neighbours that share a reading's surface"}};
}

double noise_level(const Raster<float>& depth_m, const DepthNoise& noise) {
  constexpr int kRadius = 3, kStride = 5;
  constexpr double kFewestReadings = 12.0, kOfPlane = 3.0;
  constexpr std::size_t kFewest = 50;
  std::vector<double> levels;
  for (int y = kRadius; y + kRadius < depth_m.height(); y += kStride)
    for (int x = kRadius; x + kRadius < depth_m.width(); x += kStride) {
      const float middle_m = depth_m(x, y);
      if (!std::isfinite(middle_m)) continue;
      PlaneSums sums;
      each_around(depth_m, {x, y}, kRadius, 1, [&](int u, int v, float z) {
        sums.add(u - x, v - y, static_cast<double>(z - middle_m), 1.0);
      });
      if (sums.weight() < kFewestReadings) continue;
      const double free = std::sqrt(sums.weight() / (sums.weight() - kOfPlane));
      levels.push_back(free * sums.misfit() / static_cast<double>(noise.deviation_m(middle_m)));
    }
  if (levels.size() < kFewest) return 0.0;
  // Where the scene is smoothest there is nothing but noise.
  constexpr double kSmoothest = 0.3;
  return quantile_of(levels, kSmoothest);
}

Result<SmoothDepth> smooth_depth(const Raster<float>& depth_m, const SmoothDepthOptions& options,
                                 const Work& work) {
  if (const auto valid = check_ranges(options); !valid) return valid.error();
  const double level = noise_level(depth_m, options.noise);
  if (level < options.least_level || level > options.most_level || level == 0.0)
    return SmoothDepth{depth_m, 0.0, 0};
  const DepthNoise noise{level * options.noise.floor_m, level * options.noise.per_m2};
  Smoother smoother(depth_m, noise, options, work);
  const std::size_t flying = smoother.remove_flying();
  auto smoothed = smoother.smoothed();
  if (!smoothed) return smoothed.error();
  return SmoothDepth{*std::move(smoothed), level, flying};
}

}  // namespace palpable::vision
