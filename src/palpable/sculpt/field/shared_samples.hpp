// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/field/field_branches.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// Cache of a source's samples on a root cell's lattice, half a finest cell apart, shared by neighbouring
/// cells and all levels of the tree. Its size is fixed: replaced samples are computed again.
class SharedSamples {
 public:
  SharedSamples(const DistanceSource& source, const Earlier* earlier)
      : source_(source), earlier_(earlier), slots_(earlier == nullptr ? kSlots : kSlots / 4) {}

  /// Starts a new lattice of `count` points along each axis; the first one is at `from_grid_m` from the
  /// grid's origin.
  void begin(const models::FieldGrid& grid, Vec3 from_grid_m, int count) {
    const double step_m = 0.5 * grid.cell_m;
    from_grid_m_ = from_grid_m;
    origin_m_ = grid.origin_m + from_grid_m;
    step_m_ = step_m;
    bricks_ = static_cast<std::uint64_t>(count + kBrick - 1) / kBrick;
    hint_ = {};
    ++lattice_;
  }
  struct Answer {
    models::DistanceSample sample;
    /// Whether the nearest surface point belongs to the change since the earlier field.
    bool changed = false;
    double coarse_m = 0.0, coarse_turn = 0.0;
  };
  const Answer& at(std::array<int, 3> place) {
    const std::uint64_t index = index_of(place);
    const std::uint64_t key = lattice_ << 40U | index;
    Slot& slot = slots_[index & (slots_.size() - 1)];
    if (slot.key != key) {
      const Vec3 from_first_m = step_m_ * Vec3{static_cast<double>(place[0]), static_cast<double>(place[1]),
                                               static_cast<double>(place[2])};
      slot.answer.sample = between(from_first_m);
      slot.answer.coarse_m = hint_.coarse_m;
      slot.answer.coarse_turn = hint_.coarse_turn;
      slot.answer.changed = earlier_ != nullptr &&
                            earlier_->changed_at(from_grid_m_ + from_first_m, slot.answer.sample.distance_m);
      slot.key = key;
    }
    return slot.answer;
  }
  /// All points are in this ball until leave().
  void enter(Vec3 centre_from_grid_m, double radius_m) {
    source_.enter(origin_m_ - from_grid_m_ + centre_from_grid_m, radius_m, hint_);
  }
  void leave() { source_.leave(hint_); }
  /// Since the start of the lattice.
  double greatest_difference_m() const { return hint_.greatest_difference_m; }
  /// The sample at any point relative to the lattice's first one.
  models::DistanceSample between(Vec3 from_first_m) { return source_.at(origin_m_ + from_first_m, hint_); }

 private:
  /// Index in bricks of 4 x 4 x 4 points, so that the points of a cell are near each other in memory.
  std::uint64_t index_of(std::array<int, 3> place) const {
    const auto at = [&](std::size_t axis) { return static_cast<std::uint64_t>(place[axis]); };
    const std::uint64_t brick = (at(2) / kBrick * bricks_ + at(1) / kBrick) * bricks_ + at(0) / kBrick;
    return ((brick * kBrick + at(2) % kBrick) * kBrick + at(1) % kBrick) * kBrick + at(0) % kBrick;
  }
  static constexpr int kBrick = 4;
  /// A power of two.
  static constexpr std::size_t kSlots = std::size_t{1} << 19U;
  struct alignas(64) Slot {
    /// The lattice's number, from 1, and the point in it, so that samples of earlier lattices are not used.
    std::uint64_t key = 0;
    Answer answer;
  };
  const DistanceSource& source_;
  const Earlier* earlier_;
  DistanceSource::Hint hint_;
  Vec3 origin_m_, from_grid_m_;
  double step_m_ = 0.0;
  /// Along each axis.
  std::uint64_t bricks_ = 0;
  std::uint64_t lattice_ = 0;
  std::vector<Slot> slots_;
};

}  // namespace palpable::sculpt
