// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/local_surface.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/haptics/proxy/proxy_force.hpp"

#include <limits>
#include <memory>
#include <utility>

namespace palpable::haptics {

/// The law of a device whose scene is at another computer: the force of the local surface that came last
/// (device/local_surface.hpp). A plane has a proxy of its own, which stays on it under a friction cone; the
/// force is a spring to it with the dampers of proxy_force(), and the plane's texture is added to it. A new
/// plane that would push or store more at the hand than the last one is lowered until it does not: it comes
/// up by the energy that falling planes, the damper and friction took in the last kTank_s, at most kTank_J
/// and at most kComesUp_m_per_s; nor does it stretch the spring along the plane. So a late change of the
/// surface does not push the hand with energy that the hand did not give. A pull that came with the surface
/// is added to it, with the account of its reserve kept here (add_pull()). The scene's frame is the device's.
/// Unlike other touchables it follows what the device's read() has just written, in the same tick and thread.
/// Surfaces of another kind than its own make no force: the loop changes to another touchable.
class LocalTouch final : public Touchable {
 public:
  /// `kind`: plane, slope or force. `current` must not be null. `textures`: by their numbers less one; a
  /// plane whose texture is not among them has none.
  LocalTouch(device::LocalSurface::Kind kind, std::shared_ptr<const device::CurrentSurface> current,
             Textures textures = Textures({}))
      : kind_(kind), current_(std::move(current)), textures_(std::move(textures)) {}

  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override;
  std::uint64_t state_family() const noexcept override { return static_cast<std::uint64_t>(kind_); }
  EnergyModel energy_model() const noexcept override;
  double damping_Ns_per_m() const noexcept override { return current_->surface.damping_Ns_per_m; }
  const device::ContactTransient* transient() const noexcept override { return &current_->surface.transient; }
  void touch_pages() const noexcept override {}

 private:
  static constexpr double kTank_s = 0.5;
  static constexpr double kTank_J = 0.002;
  static constexpr double kComesUp_m_per_s = 0.02;
  /// How fast a pull may change: where surfaces were lost it would do so in one tick.
  static constexpr double kPullChanges_N_per_s = 10.0;
  struct State {
    Vec3 proxy_m;
    Vec3 hand_m;
    /// The last plane: one of its points, its normal, and the time of its reading.
    Vec3 place_m;
    Vec3 normal;
    double read_at_s;
    /// Its stiffness, N/m, as far as it was valid.
    double stiffness_N_per_m;
    /// By how much the plane is rendered lower than it came, m, >= 0; and the energy that may be spent to
    /// raise it, J.
    double lowered_m;
    double tank_J;
    bool has_plane;
    bool touching;
    bool slipping;
    TextureTouch texture;
    /// The pull that came, as far as it has been followed.
    Vec3 pull_N;
  };
  struct Depth {
    double rendered_m = 0.0;
    /// How far the spring may be stretched on a new plane, and what it stored on the last one.
    double most_stretched_m = std::numeric_limits<double>::infinity();
    double held_J = 0.0;
  };
  /// Of a hand below a plane at `depth_m`, which is new or not.
  Depth depth_below(const Hand& hand, double depth_m, double stiffness_N_per_m, State& state) const noexcept;
  /// Moves the proxy; the energy that friction took, J.
  double slide(const Hand& hand, const Contact& contact, const Depth& depth, const ProxyBefore& before,
               State& state) const noexcept;
  void add_laid_texture(const Hand& hand, const TexturedPlace& at, State& state,
                        LawOutput& output) const noexcept;
  void add_sent_pull(const Hand& hand, TouchState& bytes, LawOutput& output) const noexcept;
  LawOutput on_plane(const Hand& hand, State& state) const noexcept;
  LawOutput on_slope(const Hand& hand) const noexcept;
  /// 1 within the surface's radius, 0 from twice of it on.
  double validity(Vec3 hand_m) const noexcept;

  device::LocalSurface::Kind kind_;
  std::shared_ptr<const device::CurrentSurface> current_;
  Textures textures_;
};

}  // namespace palpable::haptics
