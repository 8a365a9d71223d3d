// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable::bench {

enum class SwingSize { usual, true_size };
enum class SwingBegins { in_air, in_contact };

/// What happened to one hand on a plate that swings.
struct Swung {
  /// The greatest change of the force in a tick, N; and of what it changes by beyond stiffness x movement
  /// between hand and surface, in a contact that lasts.
  double tick_N = 0.0, step_N = 0.0;
  /// With every second hand (even seeds), whose sensor has steps of 0.1 um: the most that it received, by its
  /// true movements, since any tick beyond what the surface brought and the spring stored then; and what the
  /// program says, without the controller. J.
  double beyond_J = 0.0, said_J = 0.0, said_with_J = 0.0;
  double brought_J = 0.0;
  /// Ticks in which the hand was more than 1.2 mm below the newest surface without contact.
  int through = 0;
  int in_contact = 0;
};

/// A level plate that swings by 1 to 3 mm in the scene at 1 to 10 Hz for 4 s under a hand that rests, pushes
/// or swings at 1 to 13 Hz itself, by the seed.
Swung swing(std::uint64_t seed, SwingSize size, SwingBegins begins);

}  // namespace palpable::bench
