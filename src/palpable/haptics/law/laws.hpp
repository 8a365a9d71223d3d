// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/law/penalty.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace palpable::haptics {

/// The force laws, ours and the papers' (docs/laws.md says what each is and where it fails).
enum class Law {
  /// A ball rolling on the relief: f = -k_g grad z - k_v v. Shi & Pai 1997, eq. 1. Ignores z, always in
  /// contact.
  rolling,
  /// Their original force image: 5 x 5 Sobel at half size over 10 x 15 cm, nearest look-up. Kept for
  /// comparison.
  sobel,
  /// A surface-bound proxy with friction cone, spring and damper: the default.
  proxy,
  /// Spring and damper at the place straight below the hand. Moustakas 2007, Gomez 2012, Park & Howard 2012.
  penalty,
  /// The same on the mean of the surface at five places. Gomez 2012, chapter 12.
  averaged,
  /// A push along the boundary for a hand that moves along it. Graphic-haptic display 2006, eq. 8, corrected.
  tracing,
  /// The boundaries as grooves in a plate, felt by `proxy`: passive, for exploring by touch alone.
  groove,
  /// Spring and damper on an occupancy grid, nearest surface and normal table. Park & Howard 2012.
  grid
};

/// The name on the command line; and back, nullopt for an unknown name.
std::string_view name_of(Law law);
std::optional<Law> law_from(std::string_view name);
/// Every law that exists for a scene of this kind, the default first.
std::vector<Law> laws_for(const models::Scene& scene);

/// Which way `penalty` pushes.
enum class PenaltyDirection {
  /// Along the exact gradient of its potential: makes no energy.
  gradient,
  /// Along the surface's normal (force shading): smoother, and not conservative.
  normal
};

/// What can be set of a law. Where a value is not given, the scene's material decides.
struct LawParameters {
  Law law = Law::proxy;
  /// Of the contact spring, 0 < k <= 1e6. `rolling`, `sobel` and `tracing` take newtons
  /// here: k_g, and F_m of eq. 8 (default 1).
  std::optional<double> stiffness_N_per_m;
  /// Of the contact damper along the normal (of all motion in `rolling` and `sobel`), >= 0.
  std::optional<double> damping_Ns_per_m;
  /// Friction coefficients, 0 ... 10. A static one alone sets the dynamic one to the same value times 5/6.
  std::optional<double> static_friction;
  std::optional<double> dynamic_friction;
  /// Radius of the ball that touches, 0 ... 0.02 m; its centre is the hand's position. 0 = a point.
  double radius_m = 0.0;
  /// Of `tracing`: the neighbourhood m of eq. 7, 1 ... 32 px; not given: as the scene was made.
  std::optional<double> neighbourhood_px;
  PenaltyDirection penalty = PenaltyDirection::gradient;
  /// Of `averaged`: how far its four neighbours stand (0 ... 0.02 m), and the weights (>= 0, not both 0).
  Averaging averaging;
};

/// A relief dilated by the ball that touches it: what make_touchable() took long to make, kept by who changes
/// parameters while somebody touches. Empty at first. One thread at a time.
struct DilatedRelief {
  std::shared_ptr<const models::Relief> of;
  double radius_m = 0.0;
  std::shared_ptr<const models::Relief> surface;
};

/// Surface + law, ready for the servo loop. Work that a law needs once (dilating a relief by the ball)
/// happens here, outside the tick: up to a second for large radii; not again where `kept` already has it.
/// Errors: usage for a parameter out of its range or a law that this kind of scene does not have.
Result<std::shared_ptr<const Touchable>> make_touchable(const models::Scene& scene,
                                                        const LawParameters& parameters,
                                                        DilatedRelief* kept = nullptr);

}  // namespace palpable::haptics
