// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>

namespace palpable {

// Frames. Each is only a tag type; the compiler rejects expressions that mix frames.

/// The frame of the touched scene: metres, right-handed, x right, y up, z out of the picture towards the
/// user.
struct SceneFrame;
/// The frame of a device's workspace: metres, axes as SceneFrame (x right, y up, z towards the user), origin
/// at its centre.
struct DeviceFrame;
/// A camera: metres, x right, y down, z forward (OpenCV's convention).
struct CameraFrame;
/// The world frame of a picture sequence: metres or unit scale, right-handed.
struct WorldFrame;

/// A difference, velocity or force in `Frame`. The unit is part of the name of the variable or member.
template <class Frame>
struct Vector {
  Vec3 v;
  constexpr bool operator==(const Vector&) const = default;
  constexpr Vector& operator+=(Vector b) { return v += b.v, *this; }
  constexpr Vector& operator-=(Vector b) { return v -= b.v, *this; }
};

/// A position in `Frame`, metres.
template <class Frame>
struct Point {
  Vec3 v;
  constexpr bool operator==(const Point&) const = default;
};

template <class F>
constexpr Vector<F> operator+(Vector<F> a, Vector<F> b) {
  return {a.v + b.v};
}
template <class F>
constexpr Vector<F> operator-(Vector<F> a, Vector<F> b) {
  return {a.v - b.v};
}
template <class F>
constexpr Vector<F> operator-(Vector<F> a) {
  return {-a.v};
}
template <class F>
constexpr Vector<F> operator*(double s, Vector<F> a) {
  return {s * a.v};
}
template <class F>
constexpr Vector<F> operator-(Point<F> a, Point<F> b) {
  return {a.v - b.v};
}
template <class F>
constexpr Point<F> operator+(Point<F> a, Vector<F> b) {
  return {a.v + b.v};
}
template <class F>
constexpr Point<F> operator-(Point<F> a, Vector<F> b) {
  return {a.v - b.v};
}
template <class F>
constexpr double dot(Vector<F> a, Vector<F> b) {
  return dot(a.v, b.v);
}
template <class F>
constexpr Vector<F> cross(Vector<F> a, Vector<F> b) {
  return {cross(a.v, b.v)};
}
template <class F>
double norm(Vector<F> a) {
  return norm(a.v);
}
template <class F>
bool is_finite(Vector<F> a) {
  return is_finite(a.v);
}
template <class F>
bool is_finite(Point<F> a) {
  return is_finite(a.v);
}

/// A similarity transform from `From` to `To`: p_to = scale * rotation * p_from + translation. It is named in
/// this order: `scene_from_device * p_device`. `rotation` is row-major and must be orthonormal with
/// determinant +1; scale > 0.
template <class To, class From>
struct Transform {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 translation_m;
  double scale = 1.0;

  constexpr Vec3 rotate(Vec3 p) const {
    const auto& r = rotation;
    return {r[0] * p.x + r[1] * p.y + r[2] * p.z, r[3] * p.x + r[4] * p.y + r[5] * p.z,
            r[6] * p.x + r[7] * p.y + r[8] * p.z};
  }
  constexpr Point<To> operator*(Point<From> p) const { return {scale * rotate(p.v) + translation_m}; }
  /// Rotates and scales; for differences of positions and for velocities. For forces use rotate_force().
  constexpr Vector<To> operator*(Vector<From> p) const { return {scale * rotate(p.v)}; }

  constexpr Transform<From, To> inverse() const {
    const auto& r = rotation;
    Transform<From, To> i;
    i.rotation = {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
    i.scale = 1.0 / scale;
    i.translation_m = -(i.scale * i.rotate(translation_m));
    return i;
  }
};

/// Composition: `b` is applied first, then `a`.
template <class To, class Mid, class From>
constexpr Transform<To, From> operator*(const Transform<To, Mid>& a, const Transform<Mid, From>& b) {
  Transform<To, From> c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      c.rotation[3 * i + j] = a.rotation[3 * i] * b.rotation[j] + a.rotation[3 * i + 1] * b.rotation[3 + j] +
                              a.rotation[3 * i + 2] * b.rotation[6 + j];
  c.scale = a.scale * b.scale;
  c.translation_m = a.scale * a.rotate(b.translation_m) + a.translation_m;
  return c;
}

/// The transform as a 4 x 4 matrix, row-major, as `palpable info` prints scene_from_input.
template <class To, class From>
constexpr std::array<double, 16> matrix_of(const Transform<To, From>& t) {
  const auto& r = t.rotation;
  const auto& m = t.translation_m;
  const double s = t.scale;
  return {s * r[0], s * r[1], s * r[2], m.x, s * r[3], s * r[4], s * r[5], m.y,
          s * r[6], s * r[7], s * r[8], m.z, 0.0,      0.0,      0.0,      1.0};
}

/// Rotates a force. Its magnitude in newtons does not change if the scene is scaled.
template <class To, class From>
constexpr Vector<To> rotate_force(const Transform<To, From>& to_from, Vector<From> force_N) {
  return {to_from.rotate(force_N.v)};
}

}  // namespace palpable
