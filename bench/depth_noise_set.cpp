// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Reliefs of rooms as depth cameras see them (docs/relief.md): generated rooms, with the noise of a camera
// with structured light (its standard deviation grows with the square of depth), readings in steps of
// disparity, flying pixels at edges, and holes. It prints how much of what is flat is steep on the relief,
// how well the relief matches the exact depth, and where edges are. Options: --seeds FIRST LAST, --set NAME
// VALUE.
#include "palpable/measure/relief_score.hpp"
#include "palpable/sculpt/relief/relief_from_depth.hpp"
#include "palpable/study/world/room_view.hpp"
#include "palpable/vision/depth_camera/smooth_depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace palpable;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kFocal_px = 525.0;
const Pinhole kCamera{kFocal_px, kFocal_px, 0.5 * (kWidth - 1), 0.5 * (kHeight - 1), kWidth, kHeight};

double deviation_m(double z_m) { return 0.0012 + 0.0019 * (z_m - 0.4) * (z_m - 0.4); }

/// A camera that looks a little downwards from a corner of the room to its middle.
Transform<WorldFrame, CameraFrame> pose_in(const study::Room& room, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Vec3 eye{0.4 * room.size_m.x * (any(random) < 0.0 ? -1.0 : 1.0), 0.35 * any(random) * room.size_m.y,
                 1.3 + 0.3 * any(random)};
  const Vec3 to{0.2 * any(random) * room.size_m.x, 0.2 * any(random) * room.size_m.y, 0.8};
  const Vec3 z = unit(to - eye), x = unit(cross(z, Vec3{0, 0, 1})), y = cross(z, x);
  return {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}, eye, 1.0};
}

Raster<float> measured(const Raster<float>& exact_m, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(0.0, 1.0);
  constexpr double kFocalBaseline = 580.0 * 0.075, kDisparityStep = 0.125;
  Raster<float> out(exact_m.width(), exact_m.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      auto z = static_cast<double>(exact_m(x, y));
      if (x + 1 < out.width()) {
        const auto beside = static_cast<double>(exact_m(x + 1, y));
        if (std::abs(beside - z) > 0.1 && any(random) < 0.5) z += any(random) * (beside - z);
      }
      z += deviation_m(z) * normal(random);
      z = kFocalBaseline / (kDisparityStep * std::round(kFocalBaseline / z / kDisparityStep));
      out(x, y) = z > 0.4 && z < 8.0 ? static_cast<float>(0.001 * std::round(1000.0 * z)) : kUnknownDepth;
    }
  for (int k = 0; k < 12; ++k) {
    const int u = static_cast<int>(any(random) * kWidth), v = static_cast<int>(any(random) * kHeight);
    const int radius = 2 + static_cast<int>(8.0 * any(random));
    for (int y = std::max(0, v - radius); y < std::min(kHeight, v + radius); ++y)
      for (int x = std::max(0, u - radius); x < std::min(kWidth, u + radius); ++x)
        if ((x - u) * (x - u) + (y - v) * (y - v) < radius * radius) out(x, y) = kUnknownDepth;
  }
  return out;
}

/// Percent of the pixels that are flat within 4 pixels on the exact relief (slope below a half) and steeper
/// than 0.8 on another.
double steep_percent(const models::Relief& exact, const models::Relief& relief) {
  const auto slope = [](const models::Relief& of, int x, int y) {
    const auto& h = of.samples_m();
    const auto d = [&](int a, int b) { return static_cast<double>(h(x + a, y + b)); };
    return std::hypot(d(1, 0) - d(-1, 0), d(0, 1) - d(0, -1)) / (2.0 * of.pixel_m());
  };
  constexpr int kRim = 5;
  double flat = 0.0, steep = 0.0;
  for (int y = kRim; y + kRim < exact.samples_m().height(); ++y)
    for (int x = kRim; x + kRim < exact.samples_m().width(); ++x) {
      double steepest = 0.0;
      for (int b = -4; b <= 4; b += 2)
        for (int a = -4; a <= 4; a += 2) steepest = std::max(steepest, slope(exact, x + a, y + b));
      if (steepest > 0.5) continue;
      ++flat;
      if (slope(relief, x, y) > 0.8) ++steep;
    }
  return 100.0 * steep / flat;
}

struct Edges {
  double within_px = 0.0, height_error = 0.0, count = 0.0;
};

/// Steps between neighbours of a row that exceed ten deviations: the share of them whose steepest place is
/// within a pixel, and the mean error of their height, beside the height.
Edges edges_of(const Raster<float>& exact_m, const Raster<float>& depth_m) {
  constexpr int kReach = 4;
  Edges edges;
  for (int y = 0; y < exact_m.height(); y += 3)
    for (int x = kReach; x + kReach + 1 < exact_m.width(); ++x) {
      const double step = static_cast<double>(exact_m(x + 1, y) - exact_m(x, y));
      if (std::abs(step) < 10.0 * deviation_m(static_cast<double>(exact_m(x, y)))) continue;
      bool alone = true;
      for (int k = -kReach; k <= kReach; ++k)
        alone = alone && (k == 0 || std::abs(exact_m(x + k + 1, y) - exact_m(x + k, y)) < 0.02F);
      if (!alone) continue;
      int at = 0;
      float most = 0.0F;
      for (int k = -kReach; k <= kReach; ++k) {
        const float here = std::abs(depth_m(x + k + 1, y) - depth_m(x + k, y));
        if (here > most) most = here, at = k;
      }
      const double height = static_cast<double>(depth_m(x + 3, y) - depth_m(x - 2, y));
      const double truth = static_cast<double>(exact_m(x + 3, y) - exact_m(x - 2, y));
      if (!std::isfinite(height)) continue;
      ++edges.count;
      if (std::abs(at) <= 1) ++edges.within_px;
      edges.height_error += std::abs(height / truth - 1.0);
    }
  edges.within_px /= edges.count, edges.height_error /= edges.count;
  return edges;
}

double rms_mm(const Raster<float>& exact_m, const Raster<float>& depth_m) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < exact_m.count(); ++i) {
    const auto d = static_cast<double>(depth_m.values()[i] - exact_m.values()[i]);
    if (std::isfinite(d)) sum += std::min(d * d, 0.0025), ++count;
  }
  return 1000.0 * std::sqrt(sum / count);
}

void report(const char* what, unsigned seed, const Raster<float>& exact_m, const Raster<float>& depth_m) {
  const sculpt::ReliefOptions options;
  const auto exact = sculpt::relief_from_depth({exact_m, kCamera}, options, Work{});
  const auto relief = sculpt::relief_from_depth({depth_m, kCamera}, options, Work{});
  if (!exact || !relief) return;
  Raster<float> nearness = exact_m;
  for (float& z : nearness.values()) z = -z;
  const auto score = measure::score_relief(relief->samples_m(), relief->pixel_m(), nearness, {});
  const Edges edges = edges_of(exact_m, depth_m);
  std::printf(
      "%2u %-9s depth %5.1f mm, flat but steep %5.2f %%, correlation %.3f, details %5.1f %%, edges within "
      "1 px %5.1f %%, height off by %.2f %%\n",
      seed, what, rms_mm(exact_m, depth_m), steep_percent(*exact, *relief),
      score ? score->detail_correlation : NAN, score ? score->details_kept_percent : NAN,
      100.0 * edges.within_px, 100.0 * edges.height_error);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  unsigned first = 1, last = 6;
  vision::SmoothDepthOptions options;
  for (int i = 1; i + 2 < argc; i += 3) {
    const std::string word = argv[i];
    if (word == "--seeds")
      first = static_cast<unsigned>(std::atoi(argv[i + 1])),
      last = static_cast<unsigned>(std::atoi(argv[i + 2]));
    if (word == "--set")
      for (const Parameter& p : parameters_of(options))
        if (p.name == argv[i + 1]) (void)set_parameter(p, std::atof(argv[i + 2]));
  }
  for (unsigned seed = first; seed <= last; ++seed) {
    const study::Room room = study::make_room(seed);
    std::mt19937 random(seed);
    const auto pose = pose_in(room, random);
    const Raster<float> exact_m = study::render(room, pose, kCamera).depth_m;
    const Raster<float> seen_m = measured(exact_m, random);
    const std::clock_t begin = std::clock();
    const auto smooth = vision::smooth_depth(seen_m, options, Work{});
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const auto same = vision::smooth_depth(exact_m, options, Work{});
    if (!smooth || !same) return 1;
    std::printf("%2u level %.2f (exact depth: %.2f), %zu flying, %.1f s\n", seed, smooth->level,
                vision::noise_level(exact_m, options.noise), smooth->flying, seconds);
    report("measured", seed, exact_m, seen_m);
    report("smoothed", seed, exact_m, smooth->depth_m);
  }
  return 0;
}
