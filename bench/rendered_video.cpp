// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "rendered_video.hpp"

#include "palpable/vision/motion/tracks/printed_marker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

using Pose = Transform<WorldFrame, CameraFrame>;
// The board and the table around it; what lies farther is not judged.
constexpr double kModelRadius_m = 0.35;
constexpr double kDegree = std::numbers::pi / 180;

// A camera at `from` that looks at `to`, its x axis horizontal, then turned by small angles about its own
// axes.
Pose looking(Vec3 from, Vec3 to, Vec3 turned) {
  const Vec3 z = unit(to - from), x = unit(cross(z, Vec3{0, 0, 1})), y = cross(z, x);
  const std::array<Vec3, 3> axes{x, y, z};
  // To first order; made orthonormal again.
  const Vec3 z2 = unit(z + turned.y * axes[0] - turned.x * axes[1]);
  const Vec3 x2 = unit(x - dot(x, z2) * z2 + turned.z * y), x3 = unit(x2 - dot(x2, z2) * z2),
             y3 = cross(z2, x3);
  Pose out;
  out.rotation = {x3.x, y3.x, z2.x, x3.y, y3.y, z2.y, x3.z, y3.z, z2.z};
  out.translation_m = from;
  return out;
}

VideoConditions conditions_of(Random& random) {
  VideoConditions out;
  out.path = static_cast<VideoConditions::Path>(random.count(0, 2));
  out.arc_deg = random.between(30, 60);
  out.elevation_deg = random.between(35, 60);
  out.distance_m = random.between(0.5, 0.8);
  out.shake_m = random.between(0.0003, 0.002);
  out.shake_rad = random.between(0.001, 0.004);
  out.exposure = random.between(0.05, 0.5);
  out.readout = random.unit() < 0.4 ? random.between(0.2, 0.6) : 0.0;
  out.noise = random.between(1, 5);
  out.exposure_drift = random.between(0, 0.15);
  return out;
}

// The mean colour of a pixel's part of the surface that its ray hits: nine places on the tangent plane.
// Without it, fine tiles and letters alias, and points that are followed then slide with the moire pattern.
Colour colour_of_pixel(const TableModel& model, const ModelHit& hit, const Pose& pose, Vec3 direction,
                       double u, double v, const Pinhole& camera) {
  const Vec3 origin = pose.translation_m, place = origin + hit.distance_m * direction;
  constexpr double kSpacing_px = 1.0 / 3, kLeastCosine = 0.02;
  Colour out{};
  for (int i = -1; i <= 1; ++i)
    for (int k = -1; k <= 1; ++k) {
      const Vec3 ray = unit(pose.rotate({(u + i * kSpacing_px - camera.cx) / camera.fx,
                                         (v + k * kSpacing_px - camera.cy) / camera.fy, 1.0}));
      const double towards = dot(hit.normal, ray);
      const bool flat = std::abs(towards) < kLeastCosine;
      const Vec3 at = flat ? place : origin + dot(hit.normal, place - origin) / towards * ray;
      const Colour colour = model.colour_at(hit, at);
      for (std::size_t c = 0; c < 3; ++c) out[c] += colour[c] / 9;
    }
  return out;
}

double texture_of(std::uint32_t seed) { return seed % 3 == 0 ? 0.35 : 0.9; }

}  // namespace

RenderedVideo::RenderedVideo(std::uint32_t seed, int frames) : seed_(seed), frames_(frames) {
  Random random(seed * 7919ULL + 17);
  conditions_ = conditions_of(random);
  model_ = table_model(random, texture_of(seed));
}

void RenderedVideo::add_marker(int side_mm) {
  lay_marker(model_, vision::marker_cells(side_mm), side_mm / 1000.0);
}

std::string RenderedVideo::description() const {
  constexpr std::array kPaths{"arc", "sweep", "spiral"};
  return fmt::format(
      "seed {}: {} of {:.0f} deg, {} bodies, {}, exposure {:.2f}{}", seed_,
      kPaths[static_cast<std::size_t>(conditions_.path)], conditions_.arc_deg, model_.bodies.size() - 2,
      texture_of(seed_) < 0.5 ? "poor texture" : "rich texture", conditions_.exposure,
      conditions_.readout > 0 ? fmt::format(", rolling shutter {:.2f}", conditions_.readout) : "");
}

// Smooth random numbers of standard deviation about one: sums of three sines.
Vec3 RenderedVideo::shake_at(double frame, int axis) const {
  Vec3 out;
  std::array<double*, 3> parts{&out.x, &out.y, &out.z};
  for (std::size_t i = 0; i < 3; ++i) {
    Random random(seed_ * 31ULL + static_cast<std::uint64_t>(axis) * 7 + i);
    for (int k = 0; k < 3; ++k)
      *parts[i] +=
          0.8 * std::sin(frame * random.between(0.05, 0.9) + random.between(0, 2 * std::numbers::pi));
  }
  return out;
}

Transform<WorldFrame, CameraFrame> RenderedVideo::pose_at(double frame) const {
  const double s = frame / (frames_ - 1) - 0.5, round = conditions_.arc_deg * kDegree * s;
  double elevation = conditions_.elevation_deg * kDegree, distance = conditions_.distance_m;
  Vec3 target{0, 0, 0.02};
  double azimuth = round;
  if (conditions_.path == VideoConditions::Path::sweep) {
    azimuth = 0.3 * round;
    target.x = 0.25 * s, elevation += 15 * kDegree;
  } else if (conditions_.path == VideoConditions::Path::spiral) {
    elevation += 20 * kDegree * s, distance *= 1 - 0.15 * s;
  }
  const Vec3 from = target + distance * Vec3{std::sin(azimuth) * std::cos(elevation),
                                             -std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
  return looking(from + conditions_.shake_m * shake_at(frame, 0), target,
                 conditions_.shake_rad * shake_at(frame, 1));
}

Raster<Rgb8> RenderedVideo::picture(int frame, const Work& work) const {
  constexpr int kOpenings = 3;
  Raster<Rgb8> out(camera_.width, camera_.height);
  const double gain = 1 + conditions_.exposure_drift * std::sin(0.05 * frame + seed_);
  parallel_for(work, camera_.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const double row = frame + conditions_.readout * ((y + 0.5) / camera_.height - 0.5);
      std::array<Pose, kOpenings> poses;
      for (int k = 0; k < kOpenings; ++k)
        poses[static_cast<std::size_t>(k)] =
            pose_at(row + conditions_.exposure * ((k + 0.5) / kOpenings - 0.5));
      Random random((static_cast<std::uint64_t>(frame) << 32U) + static_cast<std::uint64_t>(y) * 2 +
                    seed_ * 977ULL);
      for (int x = 0; x < camera_.width; ++x) {
        Colour sum{};
        for (int k = 0; k < kOpenings; ++k) {
          // Each opening looks at another place of the pixel, so that edges are smooth; their mean is its
          // centre.
          const double u = x + (k - 1) / 3.0, v = y + (k == 1 ? 1.0 / 3 : -1.0 / 6);
          const Pose& pose = poses[static_cast<std::size_t>(k)];
          const Vec3 direction =
              unit(pose.rotate({(u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1.0}));
          const auto hit = model_.first_hit(pose.translation_m, direction);
          const Colour colour =
              hit ? colour_of_pixel(model_, *hit, pose, direction, u, v, camera_) : Colour{0.5, 0.5, 0.5};
          for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c] / kOpenings;
        }
        const auto level = [&](double value) {
          return static_cast<std::uint8_t>(
              std::clamp(std::lround(255 * gain * value + conditions_.noise * random.normal()), 0L, 255L));
        };
        out(x, y) = {level(sum[0]), level(sum[1]), level(sum[2])};
      }
    }
  });
  return out;
}

Raster<float> RenderedVideo::depth(int frame, const Work& work) const {
  Raster<float> out(camera_.width, camera_.height);
  const Pose pose = pose_at(frame);
  parallel_for(work, camera_.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < camera_.width; ++x) {
        const Vec3 ray{(x - camera_.cx) / camera_.fx, (y - camera_.cy) / camera_.fy, 1.0};
        const auto hit = model_.first_hit(pose.translation_m, unit(pose.rotate(ray)));
        const Vec3 place = hit ? pose.translation_m + hit->distance_m * unit(pose.rotate(ray)) : Vec3{};
        const bool near = hit && std::hypot(place.x, place.y) < kModelRadius_m;
        out(x, y) = near ? static_cast<float>(hit->distance_m / norm(ray)) : 0.0F;
      }
  });
  return out;
}

}  // namespace palpable::bench
