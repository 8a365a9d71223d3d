// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "moved_room.hpp"

#include "palpable/core/work.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <opencv2/calib3d.hpp>

namespace palpable::bench {
namespace {

constexpr double kTexels_per_m = 130.0;
constexpr double kPerDegree = std::numbers::pi / 180.0;
constexpr int kWidth = 480, kHeight = 360;
/// Rays per pixel along each axis.
constexpr int kRays = 2;

Texture random_texture(Random& random) {
  Texture t;
  const double which = random.unit();
  t.pattern = which < 0.6    ? Pattern::rough
              : which < 0.72 ? Pattern::text
              : which < 0.82 ? Pattern::tiles
              : which < 0.9  ? Pattern::stripes
                             : Pattern::plain;
  for (double& c : t.colour) c = random.between(0.25, 0.75);
  t.contrast = random.between(0.15, 0.6);
  t.scale_px = random.between(3.0, 12.0);
  t.seed = random.next();
  return t;
}

cv::Vec3d turned_about_y(const cv::Vec3d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v[0] - s * v[2], v[1], s * v[0] + c * v[2]};
}

/// Texture coordinates of a box's face or a wall whose normal is along `axis`.
Colour on_face(const Texture& texture, const cv::Vec3d& place_m, int axis, int face) {
  const double u = place_m[axis == 0 ? 2 : 0], v = place_m[axis == 1 ? 2 : 1];
  return texture.at(u * kTexels_per_m + 977.0 * face, v * kTexels_per_m);
}

}  // namespace

FurnishedRoom::FurnishedRoom(std::uint64_t seed) {
  Random random(seed * 7919U + 13U);
  half_width_m_ = random.between(1.6, 2.6);
  floor_m_ = random.between(1.0, 1.4);
  ceiling_m_ = -random.between(1.1, 1.5);
  back_m_ = random.between(3.5, 5.5);
  for (Texture& wall : walls_) {
    wall = random_texture(random);
    // Walls without a period: they are most of the picture.
    wall.pattern = Pattern::rough;
  }
  const int count = random.count(8, 14);
  for (int i = 0; i < count; ++i) {
    Furniture f;
    f.form = random.unit() < 0.35 ? Furniture::Form::ball : Furniture::Form::box;
    const double z = random.between(1.4, back_m_ - 0.4), reach = std::min(half_width_m_ - 0.2, 0.62 * z);
    const double size = random.between(0.08, 0.2) * std::sqrt(z);
    f.half_m = {size, size * random.between(0.6, 1.8), size * random.between(0.6, 1.4)};
    f.centre_m = {random.between(-reach, reach), random.between(-0.42 * z, 0.45 * z), z};
    if (random.unit() < 0.5) f.centre_m[1] = floor_m_ - f.half_m[1];
    f.turn = random.between(0.0, std::numbers::pi);
    f.texture = random_texture(random);
    pieces_.push_back(f);
  }
}

FurnishedRoom::Met FurnishedRoom::first_met(const Ray& ray) const {
  Met met{std::numeric_limits<double>::infinity(), {}};
  const auto wall = [&](int axis, double at_m, std::size_t which) {
    const double t = (at_m - ray.from_m[axis]) / ray.towards[axis];
    if (!(t > 1e-6) || t >= met.distance) return;
    met = {t, on_face(walls_[which], ray.from_m + t * ray.towards, axis, static_cast<int>(which))};
  };
  wall(0, half_width_m_, 0);
  wall(0, -half_width_m_, 1);
  wall(1, floor_m_, 2);
  wall(1, ceiling_m_, 3);
  wall(2, back_m_, 4);
  for (const Furniture& f : pieces_) {
    const cv::Vec3d from = turned_about_y(ray.from_m - f.centre_m, f.turn),
                    towards = turned_about_y(ray.towards, f.turn);
    if (f.form == Furniture::Form::ball) {
      const double r = f.half_m[0], a = towards.dot(towards), b = from.dot(towards),
                   c = from.dot(from) - r * r;
      const double root = b * b - a * c;
      if (root < 0.0) continue;
      const double t = (-b - std::sqrt(root)) / a;
      if (!(t > 1e-6) || t >= met.distance) continue;
      const cv::Vec3d n = from + t * towards;
      met = {t, f.texture.at(std::atan2(n[0], n[2]) * r * kTexels_per_m,
                             std::asin(std::clamp(n[1] / r, -1.0, 1.0)) * r * kTexels_per_m)};
      continue;
    }
    double in = -std::numeric_limits<double>::infinity(), out = -in;
    int axis = 0;
    for (int k = 0; k < 3; ++k) {
      const double t0 = (-f.half_m[k] - from[k]) / towards[k], t1 = (f.half_m[k] - from[k]) / towards[k];
      if (std::min(t0, t1) > in) {
        in = std::min(t0, t1);
        axis = k;
      }
      out = std::min(out, std::max(t0, t1));
    }
    if (!(in < out) || !(in > 1e-6) || in >= met.distance) continue;
    met = {in, on_face(f.texture, from + in * towards, axis, axis)};
  }
  return met;
}

FurnishedRoom::View FurnishedRoom::seen_by(const RoomCamera& camera, int width, int height,
                                           std::uint64_t noise_seed) const {
  View view{{width, height, 3, 8, std::vector<float>(static_cast<std::size_t>(width) * height * 3)},
            Raster<float>(width, height)};
  for (int y = 0; y < height; ++y) {
    const double late = (y + 0.5) / height - 0.5;
    cv::Matx33d room_from_camera;
    cv::Rodrigues(camera.turn + late * camera.readout_turn, room_from_camera);
    const cv::Vec3d from = camera.position_m + late * camera.readout_move_m;
    const auto ray = [&](double px, double py) {
      return Ray{from, room_from_camera *
                           cv::Vec3d((px - 0.5 * (width - 1) - camera.off_middle_px) / camera.focal_px,
                                     (py - 0.5 * (height - 1)) / camera.focal_px, 1.0)};
    };
    Random noise(noise_seed * 1000003U + static_cast<std::uint64_t>(y));
    for (int x = 0; x < width; ++x) {
      // Rays have a unit part along the camera's axis, so distances are depths.
      view.depth_m(x, y) = static_cast<float>(first_met(ray(x, y)).distance);
      Colour sum{};
      for (int k = 0; k < kRays * kRays; ++k) {
        const Met met =
            first_met(ray(x + (k % kRays + 0.5) / kRays - 0.5, y + (k / kRays + 0.5) / kRays - 0.5));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += met.colour[c] / (kRays * kRays);
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const double exposed = camera.gain * sum[c] + camera.noise * noise.normal();
        view.picture.samples[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x)) *
                                 3 +
                             c] =
            static_cast<float>(std::round(std::clamp(exposed, 0.0, 1.0) * 255.0) / 255.0);
      }
    }
  }
  return view;
}

std::string_view name_of(Movement movement) {
  static constexpr std::array<std::string_view, kMovements> kNames{
      "sideways",  "upwards",         "oblique",       "forward",  "backward",  "rolled",
      "turned",    "zoomed-sideways", "zoomed-up",     "axis-off", "hand-held", "rolling-shutter",
      "zoom-only", "turn-only",       "turn-and-zoom", "twice",    "elsewhere", "mirrored"};
  return kNames[static_cast<std::size_t>(movement)];
}

bool is_hopeless(Movement movement) { return movement >= Movement::zoom_only; }

namespace {

double either_sign(Random& random, double least, double most) {
  return random.between(least, most) * (random.unit() < 0.5 ? -1.0 : 1.0);
}

cv::Vec3d turns(Random& random, double most_deg) {
  return cv::Vec3d(random.between(-most_deg, most_deg), random.between(-most_deg, most_deg),
                   random.between(-most_deg, most_deg)) *
         kPerDegree;
}

/// The right camera beside a left one that is at the origin.
RoomCamera moved_camera(Movement movement, RoomCamera camera, Random& random) {
  const double b = random.between(0.08, 0.16);
  const auto zoom = [&] { return 1.0 + either_sign(random, 0.03, 0.10); };
  cv::Vec3d& place = camera.position_m;
  camera.turn = turns(random, 0.5);
  switch (movement) {
    case Movement::sideways:
      place = {b, 0, 0};
      break;
    case Movement::upwards:
      place = {random.between(-0.2, 0.2) * b, random.unit() < 0.5 ? -b : b, 0};
      break;
    case Movement::oblique: {
      const double angle = random.between(0.0, 2.0 * std::numbers::pi);
      place = {b * std::cos(angle), b * std::sin(angle), 0};
      break;
    }
    case Movement::forward:
    case Movement::backward: {
      const double along = random.between(0.25, 0.5) * (movement == Movement::forward ? 1.0 : -1.0);
      place = {random.between(-0.2, 0.2) * along, random.between(-0.2, 0.2) * along, along};
      camera.turn = turns(random, 2.0);
      break;
    }
    case Movement::rolled:
      place = {b, 0, 0};
      camera.turn[2] = either_sign(random, 5.0, 15.0) * kPerDegree;
      break;
    case Movement::turned:
      place = {b, 0, 0};
      camera.turn[0] = either_sign(random, 0.0, 5.0) * kPerDegree;
      camera.turn[1] = either_sign(random, 3.0, 8.0) * kPerDegree;
      break;
    case Movement::zoomed_sideways:
      place = {b, 0, 0};
      camera.focal_px *= zoom();
      break;
    case Movement::zoomed_up:
      place = {0, -b, 0};
      camera.focal_px *= zoom();
      break;
    case Movement::axis_off:
      place = cv::normalize(cv::Vec3d(1.0, random.between(-0.05, 0.05), either_sign(random, 0.1, 0.2))) * b;
      camera.turn = turns(random, 1.5);
      break;
    case Movement::hand_held:
    case Movement::rolling_shutter:
      place = cv::Vec3d(1.0, random.between(-0.3, 0.3), random.between(-0.3, 0.3)) * b;
      camera.turn = turns(random, 3.0);
      camera.focal_px *= 1.0 + random.between(-0.01, 0.01);
      camera.gain = random.between(0.85, 1.15);
      camera.noise = 3.0 / 255.0;
      if (movement == Movement::hand_held) break;
      // A phone's shutter of 20 ms in a hand that moves at 0.1 m/s and turns at 10 degrees/s.
      camera.readout_move_m = cv::Vec3d(random.normal(), random.normal(), random.normal()) * 0.002;
      camera.readout_turn = cv::Vec3d(random.normal(), random.normal(), random.normal()) * 0.2 * kPerDegree;
      break;
    case Movement::zoom_only:
      camera.focal_px *= zoom();
      break;
    case Movement::turn_only:
      camera.turn = cv::normalize(cv::Vec3d(random.normal(), random.normal(), random.normal())) *
                    random.between(2.0, 8.0) * kPerDegree;
      break;
    case Movement::turn_and_zoom:
      camera.turn = turns(random, 4.0);
      camera.focal_px *= zoom();
      break;
    case Movement::mirrored:
      place = {b, 0, 0};
      break;
    case Movement::twice:
    case Movement::elsewhere:
      camera.turn = {0, 0, 0};
      break;
  }
  return camera;
}

Image mirrored(const Image& image) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.pixel(image.width - 1 - x, y), 3,
                  out.samples.begin() + (image.pixel(x, y) - image.samples.data()));
  return out;
}

}  // namespace

MovedPair moved_pair(Movement movement, std::uint64_t seed) {
  Random random(seed * 104729U + static_cast<std::uint64_t>(movement) * 31U + 5U);
  const FurnishedRoom room(seed), other(seed + 500000U);
  RoomCamera left;
  left.focal_px = random.between(340.0, 460.0);
  const RoomCamera right = moved_camera(movement, left, random);
  const auto seen = room.seen_by(left, kWidth, kHeight, 2 * seed);
  auto second =
      (movement == Movement::elsewhere ? other : room).seen_by(right, kWidth, kHeight, 2 * seed + 1);
  if (movement == Movement::mirrored) second.picture = mirrored(second.picture);
  return {{seen.picture, second.picture, {}}, seen.depth_m, left.focal_px, cv::norm(right.position_m)};
}

}  // namespace palpable::bench
