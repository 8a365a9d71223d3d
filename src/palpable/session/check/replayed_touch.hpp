// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/haptics/tick/hand_motion.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/session/check/recorded_scenes.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <memory>
#include <optional>

namespace palpable::session {

/// Recomputes the complete ticks of the servo offline from a recording's readings, with the same pipeline and
/// the same arithmetic. This is possible from a session's first tick on, while no tick is missing and every
/// scene is available. One thread.
class ReplayedTouch {
 public:
  ReplayedTouch(const RecordedSession& session, RecordedScenes& scenes);
  ~ReplayedTouch();
  ReplayedTouch(const ReplayedTouch&) = delete;
  ReplayedTouch& operator=(const ReplayedTouch&) = delete;

  /// The hand's next recorded tick, recomputed. Null if that is not possible, from then on; why() gives the
  /// reason.
  const device::TouchSample* step(const device::TouchSample& recorded);
  const std::string& why() const { return why_; }
  /// Counts over the recomputed ticks.
  haptics::TickCounts counts() const;

 private:
  struct Running;
  bool begin(const device::TouchSample& first);
  bool change_scene(const device::TouchSample& recorded);
  bool lose(std::string why);

  const RecordedSession& session_;
  RecordedScenes& scenes_;
  std::unique_ptr<Running> running_;
  haptics::TickCounts counts_;
  std::string why_;
  std::uint64_t next_tick_ = 0;
  bool lost_ = false;
};

/// The hand as the servo gave it to the law, tick by tick: recorded positions and velocities, and what is not
/// recorded (its expected motion until the force acts), which is recomputed by the class that the servo uses.
/// One thread.
class ReplayedHand {
 public:
  explicit ReplayedHand(const RecordedSession& session);

  /// The next recorded tick.
  void step(const device::TouchSample& recorded);
  /// The law's input at that tick.
  haptics::Hand in(const haptics::HapticScene& scene) const;

 private:
  /// None if the session is an older program's, whose laws did not look ahead.
  std::optional<haptics::HandMotion> motion_;
  device::TouchSample recorded_;
  double passed_s_ = 0.0;
};

/// Recomputes the law alone at the recorded hand positions, from the first tick of each touch; and from the
/// first one in free air, where the law's state is assumed to be that of a new touch. This works for old
/// recordings, for those that began during a touch, and after another scene that is not given, but not during
/// changes of scene. One thread.
class ReplayedLaw {
 public:
  ReplayedLaw(const RecordedSession& session, RecordedScenes& scenes) : hand_(session), scenes_(scenes) {}

  /// The law's output at the next recorded tick; nullopt if it cannot be determined.
  std::optional<haptics::LawOutput> step(const device::TouchSample& recorded);
  /// Whether the state of the last output was assumed: a law may remember from earlier contacts where it
  /// looks for the surface, so single forces may differ by a little.
  bool is_assumed() const { return assumed_; }

 private:
  ReplayedHand hand_;
  RecordedScenes& scenes_;
  haptics::TouchState state_;
  bool known_ = false;
  bool assumed_ = false;
  std::uint32_t scene_id_ = 0;
  std::uint64_t next_tick_ = 0;
};

}  // namespace palpable::session
