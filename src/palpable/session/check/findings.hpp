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

/// What can be found in a recording. Those from `missed` on are the machine's or the file's, and no fault of
/// the forces.
enum class FindingKind : std::uint8_t {
  /// Recomputed, the law gives another force or torque; likewise the written force, the energy balance, and
  /// what else a tick holds (position, velocity, proxy, contact, flags).
  law_force,
  written_force,
  energy_balance,
  state,
  /// The written force grew faster than the rise limit allows.
  force_step,
  /// It is greater than the device's greatest, or not finite.
  force_cap,
  not_finite,
  /// The hand and its way were clear of the surface, and a force was written.
  free_air,
  /// The hand received more than it gave, in a contact that began in free air.
  energy_made,
  /// A part of the file is damaged, or ticks are missing in it.
  damage,
  lost_ticks,
  missed,
  interrupted,
  /// Ticks that could not be recomputed.
  not_recomputed
};
inline constexpr std::size_t kFindingKinds = 14;

/// "law-force", …: its name in JSON.
std::string_view name_of(FindingKind kind);
/// Whether it makes a recording not clean.
bool is_problem(FindingKind kind);

/// Findings of one kind in ticks that follow each other closely.
struct Finding {
  FindingKind kind = FindingKind::law_force;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  /// Of the first; seconds since the loop began.
  double t_s = 0.0;
  /// In how many of them.
  std::uint64_t ticks = 0;
  /// The greatest: N, J, or periods, as unit_of(kind) says; infinite where a value that was compared is not a
  /// finite number.
  double size = 0.0;
  /// Why, where the kind does not say it all.
  std::string detail;
};

/// The unit of Finding::size: "N", "J", "ticks"; empty where the size says nothing.
std::string_view unit_of(FindingKind kind);
/// "Tick 5012 (5.012 s): the written force differs from the recomputed one by 0.3 N."
std::string sentence_of(const Finding& finding);

/// Collects findings; neighbours become one. Keeps so many of each kind and counts the rest.
class Findings {
 public:
  explicit Findings(std::size_t most_of_a_kind) : most_of_a_kind_(most_of_a_kind) {}

  void add(FindingKind kind, const device::TouchSample& at, double size, std::string_view detail = {});
  /// By their first tick; afterwards empty.
  std::vector<Finding> take();
  /// How many there were of a kind, and how many of all that are not kept.
  std::uint64_t count(FindingKind kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  std::uint64_t not_kept() const { return not_kept_; }

 private:
  /// Ticks closer than this belong together.
  static constexpr std::uint64_t kTogether = 20;
  void close(Finding& finding);

  std::size_t most_of_a_kind_;
  /// Of each kind the one that may go on; ticks = 0: none.
  Finding open_[kFindingKinds];
  std::uint64_t counts_[kFindingKinds] = {};
  std::size_t kept_of_[kFindingKinds] = {};
  std::vector<Finding> kept_;
  std::uint64_t not_kept_ = 0;
};

}  // namespace palpable::session
