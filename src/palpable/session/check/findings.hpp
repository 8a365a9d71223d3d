// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/touch_sample.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::session {

/// Kinds of findings in a recording. Those from `missed` on concern the machine or the file, not the forces.
enum class FindingKind : std::uint8_t {
  /// The recomputed force or torque of the law differs; likewise the written force, the energy balance, and
  /// the other values of a tick (position, velocity, proxy, contact, flags).
  law_force,
  written_force,
  energy_balance,
  state,
  /// The written force grew faster than the rise limit allows.
  force_step,
  /// It exceeds the device's greatest force, or is not finite.
  force_cap,
  not_finite,
  /// A force acted on without a tick, and no tick says that it was cut.
  held_force,
  /// A force was written although the hand and its path were clear of the surface.
  free_air,
  /// The hand received more energy than it delivered, in a contact that began in free air.
  energy_made,
  /// A part of the file is damaged, or ticks are missing.
  damage,
  lost_ticks,
  missed,
  interrupted,
  /// Ticks that could not be recomputed.
  not_recomputed
};
inline constexpr std::size_t kFindingKinds = 15;

/// Its name in JSON: "law-force" ...
std::string_view name_of(FindingKind kind);
/// Whether a finding of this kind is a problem, so that the recording does not pass the check.
bool is_problem(FindingKind kind);

/// Consecutive findings of one kind (ticks at most Findings::kTogether apart).
struct Finding {
  FindingKind kind = FindingKind::law_force;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  /// Time of the first tick; seconds since the loop began.
  double t_s = 0.0;
  /// Number of ticks with this finding.
  std::uint64_t ticks = 0;
  /// Greatest value in the unit of unit_of(kind): N, J or periods; infinite if one of the compared values is
  /// not finite.
  double size = 0.0;
  /// The longest time that a force was held (held_force), s; 0 for other kinds.
  double held_s = 0.0;
  /// The cause, if the kind alone does not tell it.
  std::string detail;
};

/// The unit of Finding::size: "N", "J", "ticks"; empty if the size has no meaning.
std::string_view unit_of(FindingKind kind);
/// "Tick 5012 (5.012 s): the written force differs from the recomputed one by 0.3 N."
std::string sentence_of(const Finding& finding);

/// Collects findings and merges neighbouring ones. Keeps a limited number of each kind and counts the rest.
class Findings {
 public:
  explicit Findings(std::size_t most_of_a_kind) : most_of_a_kind_(most_of_a_kind) {}

  void add(FindingKind kind, const device::TouchSample& at, double size, std::string_view detail = {},
           double held_s = 0.0);
  /// The findings in order of their first ticks; the collection is empty afterwards.
  std::vector<Finding> take();
  /// Number of findings of a kind, and number of all findings that were not kept.
  std::uint64_t count(FindingKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  std::uint64_t not_kept() const { return not_kept_; }

 private:
  /// Findings in ticks at most this many apart are merged.
  static constexpr std::uint64_t kTogether = 20;
  void close(Finding& finding);

  std::size_t most_of_a_kind_;
  /// For each kind the finding that may still grow; ticks = 0: none.
  Finding open_[kFindingKinds];
  std::uint64_t counts_[kFindingKinds] = {};
  std::size_t kept_of_[kFindingKinds] = {};
  std::vector<Finding> kept_;
  std::uint64_t not_kept_ = 0;
};

}  // namespace palpable::session
