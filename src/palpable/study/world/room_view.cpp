// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/room_view.hpp"

#include "palpable/study/world/solid.hpp"

#include <array>
#include <numbers>

namespace palpable::study {
namespace {

/// SplitMix64's output function (Steele et al. 2014).
std::uint64_t scrambled(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// A nearly normal number of mean 0 and variance 1: the sum of four uniform ones of 16 bits (|x| < 3.5).
double normal_number(std::uint64_t key) {
  const std::uint64_t bits = scrambled(key);
  const std::uint64_t sum =
      (bits & 0xFFFFU) + (bits >> 16U & 0xFFFFU) + (bits >> 32U & 0xFFFFU) + (bits >> 48U);
  // The variance of the sum is 4 / 12.
  return (static_cast<double>(sum) * 0x1p-16 - 2.0) * std::numbers::sqrt3;
}

/// A random value in [-1, 1] at a lattice point.
double lattice(int i, int j, std::uint32_t key) {
  std::uint32_t h =
      static_cast<std::uint32_t>(i) * 0x8DA6B343U ^ static_cast<std::uint32_t>(j) * 0xD8163841U ^ key;
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h ^= h >> 12U;
  return static_cast<double>(h & 0xFFFFU) / 32767.5 - 1.0;
}

/// The greatest integer that is not greater; std::floor() is a call on processors without SSE 4.1.
int whole(double x) {
  const int i = static_cast<int>(x);
  return i - static_cast<int>(x < i);
}

/// Bilinear noise in [-1, 1] with cells of `cell_m`.
double value_noise(double u_m, double v_m, double cell_m, std::uint32_t key) {
  const double u = u_m / cell_m;
  const double v = v_m / cell_m;
  const int i = whole(u);
  const int j = whole(v);
  const double a = u - i;
  const double b = v - j;
  return (1 - b) * ((1 - a) * lattice(i, j, key) + a * lattice(i + 1, j, key)) +
         b * ((1 - a) * lattice(i, j + 1, key) + a * lattice(i + 1, j + 1, key));
}

/// Brightness of a pattern, about 0.5 ... 1.2.
double pattern_at(const Finish& finish, const Hit& hit) {
  const auto cell = [&](double x) { return whole(x / finish.pattern_m); };
  const auto key = static_cast<std::uint32_t>(hit.object + 8) * 0x9E3779B9U;
  int odd = 0;
  if (finish.pattern == Pattern::stripes) odd = cell(hit.u_m) & 1;
  if (finish.pattern == Pattern::checks) odd = (cell(hit.u_m) + cell(hit.v_m)) & 1;
  return 0.9 - 0.15 * odd + 0.13 * value_noise(hit.u_m, hit.v_m, 0.05, key) +
         0.13 * value_noise(hit.u_m, hit.v_m, 0.013, ~key);
}

const Finish& finish_of(const Room& room, int object) {
  switch (object) {
    case kFloor:
      return room.floor;
    case kWalls:
      return room.walls;
    case kCeiling:
      return room.ceiling;
    default:
      return room.furniture[static_cast<std::size_t>(object)].finish;
  }
}

/// The picture while it is made.
class Picture {
 public:
  Picture(const Room& room, const Transform<WorldFrame, CameraFrame>& pose, const Pinhole& camera)
      : room_(room), pose_(pose), camera_(camera), hits_(camera.width, camera.height) {
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        hits_(x, y) = leave_room(room.size_m, pose.translation_m, direction(x, y));
    for (std::size_t k = 0; k < room.furniture.size(); ++k)
      for (const Solid& solid : room.furniture[k].solids) draw(solid, static_cast<int>(k));
  }

  /// Along a ray of this direction, a hit's distance is its depth.
  Vec3 direction(int x, int y) const {
    return pose_.rotate({(x - camera_.cx) / camera_.fx, (y - camera_.cy) / camera_.fy, 1.0});
  }
  const Hit& hit(int x, int y) const { return hits_(x, y); }

 private:
  struct Window {
    int left, top, right, bottom;
  };

  /// Pixels that may see a solid: those around its corners' images, or all if one is not in front.
  Window window_of(const TurnedSolid& turned) const {
    const Window all{0, 0, camera_.width - 1, camera_.height - 1};
    const auto camera_from_world = pose_.inverse();
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
    bool before = false, behind = false;
    for (int k = 0; k < 8; ++k) {
      const Vec3& h = turned.solid.half_m;
      const Vec3 corner{k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z};
      const Vec3 p = (camera_from_world * Point<WorldFrame>{turned.solid.centre_m + turned.out(corner)}).v;
      (p.z > 1e-3 ? before : behind) = true;
      left = std::min(left, p.x / p.z), right = std::max(right, p.x / p.z);
      top = std::min(top, p.y / p.z), bottom = std::max(bottom, p.y / p.z);
    }
    if (!before) return {0, 0, -1, -1};
    if (behind) return all;
    const auto pixel = [](double at, int size) {
      return static_cast<int>(std::clamp(at, -1.0, static_cast<double>(size)));
    };
    return {std::max(0, pixel(std::floor(camera_.cx + camera_.fx * left), camera_.width)),
            std::max(0, pixel(std::floor(camera_.cy + camera_.fy * top), camera_.height)),
            std::min(all.right, pixel(std::ceil(camera_.cx + camera_.fx * right), camera_.width)),
            std::min(all.bottom, pixel(std::ceil(camera_.cy + camera_.fy * bottom), camera_.height))};
  }

  void draw(const Solid& solid, int object) {
    const TurnedSolid turned(solid);
    const Window w = window_of(turned);
    const Vec3 origin = turned.into(pose_.translation_m - solid.centre_m);
    for (int y = w.top; y <= w.bottom; ++y)
      for (int x = w.left; x <= w.right; ++x) {
        Hit hit;
        hit.along = enter(solid, origin, turned.into(direction(x, y)), hit);
        if (!(hit.along < hits_(x, y).along)) continue;
        hit.normal = turned.out(hit.normal);
        hit.object = object;
        hits_(x, y) = hit;
      }
  }

  const Room& room_;
  const Transform<WorldFrame, CameraFrame>& pose_;
  const Pinhole& camera_;
  Raster<Hit> hits_;
};

std::uint8_t channel(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

/// A fixed light: from above, a little from one side, so that the faces of a box differ.
double light_on(Vec3 normal) { return 0.78 + 0.17 * normal.z + 0.10 * normal.x - 0.06 * normal.y; }

float measured_depth(double depth_m, const CameraNoise& noise, std::uint64_t key) {
  const double deviation_m = noise.depth.floor_m + noise.depth.per_m2 * depth_m * depth_m;
  const double z = deviation_m > 0.0 ? depth_m + deviation_m * normal_number(key) : depth_m;
  return z >= noise.near_m && z <= noise.far_m ? static_cast<float>(z) : kUnknownDepth;
}

}  // namespace

RoomView render(const Room& room, const Transform<WorldFrame, CameraFrame>& world_from_camera,
                const Pinhole& camera, const CameraNoise& noise) {
  const Picture picture(room, world_from_camera, camera);
  RoomView view{Raster<float>(camera.width, camera.height), Raster<Rgb8>(camera.width, camera.height),
                Raster<std::int16_t>(camera.width, camera.height)};
  std::uint64_t key = scrambled(noise.seed + 1);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const Hit& hit = picture.hit(x, y);
      const Finish& finish = finish_of(room, hit.object);
      const double light = light_on(hit.normal) * pattern_at(finish, hit);
      std::array<double, 3> rgb{light * finish.colour.r, light * finish.colour.g, light * finish.colour.b};
      key += 0x9E3779B97F4A7C15U;
      if (noise.colour > 0.0)
        for (std::size_t c = 0; c < 3; ++c) rgb[c] += noise.colour * normal_number(key + 7 * (c + 1));
      view.colour(x, y) = {channel(rgb[0]), channel(rgb[1]), channel(rgb[2])};
      view.object(x, y) = static_cast<std::int16_t>(hit.object);
      view.depth_m(x, y) = measured_depth(hit.along, noise, key);
    }
  return view;
}

Pinhole camera_of(int width, int height, double field_of_view_rad) {
  const double f = width / 2.0 / std::tan(field_of_view_rad / 2.0);
  return {f, f, (width - 1) / 2.0, (height - 1) / 2.0, width, height};
}

}  // namespace palpable::study
