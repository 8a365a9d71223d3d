// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/haptics/effect/law_output.hpp"
#include "palpable/models/scene/route_guide.hpp"

#include <cstddef>
#include <vector>

namespace palpable::haptics {

/// State of a pull in a touch. All zero = a new touch.
struct PullTouch {
  /// The force of the previous tick, and where it began to act.
  Vec3 force_N;
  Vec3 place_m;
  /// The reserve, by which one pull is told from another, and what it has given, J.
  double reserve_J;
  double spent_J;
  /// The part of the force that is rendered, 0 ... 1, which grows smoothly.
  double share;
};

/// Adds a pull to a law's output: in contact only, with a force that begins smoothly. As the reserve ends so
/// does the pull, and work against the pull refills it by half. So all that it can ever give in a touch is
/// bounded, wherever the hand goes; the observer counts its work apart (LawOutput::guide_N). Another reserve
/// belongs to another pull and is full. Tick path.
void add_pull(const Hand& hand, Vec3 wanted_N, double reserve_J, PullTouch& state,
              LawOutput& output) noexcept;

/// A gentle pull along a way (add_pull()). Its force lies in the plane and never exceeds that of the guide.
/// Its reserve is twice the force times the length of the way. Immutable; tick path without allocation.
class RoutePull {
 public:
  /// `guide` must be valid. Computes the force on a lattice of samples around the way, within `half_size_m`
  /// of the origin in x and y.
  explicit RoutePull(const models::RouteGuide& guide, Vec3 half_size_m = {1.0, 1.0, 1.0});

  /// The pull of a full reserve at a place; continuous; 0 far from the way.
  Vec3 force_N(Vec3 place_m) const noexcept;
  double reserve_J() const noexcept { return reserve_J_; }
  std::size_t memory_bytes() const noexcept { return forces_.size() * sizeof(Sample); }
  const void* data() const noexcept { return forces_.data(); }

  /// Adds the pull to a law's output.
  void add(const Hand& hand, PullTouch& state, LawOutput& output) const noexcept;

 private:
  struct Sample {
    float x = 0.0F;
    float y = 0.0F;
  };
  double reserve_J_ = 0.0;
  /// The lattice: its lowest place, spacing and size.
  double left_m_ = 0.0;
  double bottom_m_ = 0.0;
  double spacing_m_ = 0.001;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<Sample> forces_;
};

}  // namespace palpable::haptics
