// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/contact_transient.hpp"
#include "palpable/device/hand_account.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

namespace palpable::device {

/// The texture of a plane, which the device's loop adds to it as the scene's law does.
struct LaidTexture {
  /// Of the list that was sent (LocalTextures), from 1; 0 = none.
  std::uint16_t number = 0;
  enum class Onto : std::uint8_t { plan, solid };
  Onto onto = Onto::plan;
  /// scene_from_device: rotation (row-major), metres, and metres in the scene per metre at the device.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 translation_m;
  double scale = 1.0;

  bool operator==(const LaidTexture&) const = default;
};

/// What a hand touches near one place, simple enough for a device's own loop to compute its forces until a
/// newer one arrives: over a network, a force would act too late, and generate energy (Adams & Hannaford 1999
/// call it a virtual coupling; Mitra & Niemeyer 2008, a local model). Trivially copyable.
struct LocalSurface {
  enum class Kind : std::uint8_t {
    /// No force is wanted, or nothing is known: the device ramps its force to zero.
    none,
    /// Free air: no force.
    free,
    /// A plane with a spring, a damper along its normal, and friction.
    plane,
    /// A potential whose gradient is constant, with a damper: a weight on a slope.
    slope,
    /// A constant force whose energy is not known.
    force
  };
  Kind kind = Kind::none;
  /// Where the hand was: what follows holds within `radius_m` (> 0) of this place. At twice this distance
  /// the device makes no force.
  Point<DeviceFrame> hand;
  double radius_m = 0.02;
  /// plane: one of its points, and its outward unit normal.
  Point<DeviceFrame> place;
  Vector<DeviceFrame> normal;
  double stiffness_N_per_m = 0.0;
  /// plane: along the normal; slope: of all motion.
  double damping_Ns_per_m = 0.0;
  double static_friction = 0.0;
  double dynamic_friction = 0.0;
  LaidTexture texture;
  /// slope, force: the force at `hand`, without damping; and the energy that the slope stores there.
  Vector<DeviceFrame> force_N;
  double stored_J = 0.0;
  /// A gentle pull along a way, beside these forces, in contact only; and what it may give to the hand in
  /// this touch, J. No pull if that is 0.
  Vector<DeviceFrame> pull_N;
  double pull_reserve_J = 0.0;
  /// Vibration after an impact.
  ContactTransient transient;
  /// When the device read the position that this was computed from, in seconds of the device's own clock; set
  /// by the driver.
  double read_at_s = 0.0;

  bool operator==(const LocalSurface&) const = default;
};

inline constexpr std::uint16_t kMostTextures = 256;

/// Whether all values are finite and in the ranges that surfaces of Palpable have. Of a peer that sends
/// others nothing is believed.
inline bool is_valid(const LocalSurface& surface) noexcept {
  constexpr double kFar_m = 100.0, kMost = 1e6, kMostForce_N = 1e3;
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  const auto all_within = [&](Vec3 v, double most) {
    return within(v.x, -most, most) && within(v.y, -most, most) && within(v.z, -most, most);
  };
  const bool has_normal = surface.kind != LocalSurface::Kind::plane ||
                          (is_finite(surface.normal) && std::abs(norm(surface.normal) - 1.0) < 1e-6);
  const LaidTexture& laid = surface.texture;
  bool is_laid = laid.number <= kMostTextures && laid.onto <= LaidTexture::Onto::solid &&
                 all_within(laid.translation_m, kFar_m) && within(laid.scale, 1e-6, kMost);
  for (const double value : laid.rotation) is_laid = is_laid && within(value, -1.001, 1.001);
  return is_laid && surface.kind <= LocalSurface::Kind::force && all_within(surface.hand.v, kFar_m) &&
         within(surface.radius_m, 1e-6, kFar_m) && all_within(surface.place.v, kFar_m) && has_normal &&
         all_within(surface.normal.v, 2.0) && within(surface.stiffness_N_per_m, 0.0, kMost) &&
         within(surface.damping_Ns_per_m, 0.0, kMost) && within(surface.static_friction, 0.0, kMost) &&
         within(surface.dynamic_friction, 0.0, kMost) && all_within(surface.force_N.v, kMostForce_N) &&
         all_within(surface.pull_N.v, kMostForce_N) && within(surface.pull_reserve_J, 0.0, kMost) &&
         is_valid(surface.transient) && within(surface.stored_J, -kMost, kMost) &&
         within(surface.read_at_s, 0.0, 1e12);
}

/// The surface that a device's loop renders now. The device's read() writes it and the law reads it, in the
/// same tick of one thread.
struct CurrentSurface {
  LocalSurface surface;
  /// It is not too old.
  bool is_usable = false;
  /// What it may give to the hand.
  HandAccount account = {};
};

class LocalTextures;

/// An additional interface of devices that compute forces themselves from a local surface.
class TakesLocalSurface {
 public:
  virtual ~TakesLocalSurface() = default;
  /// Called in each tick before Device::write(), whose force then only says what was computed here. Tick
  /// path.
  virtual void write_surface(const LocalSurface& surface) noexcept = 0;
  /// Where the scene's textures are put; never null.
  virtual std::shared_ptr<LocalTextures> textures() noexcept = 0;
};

}  // namespace palpable::device
