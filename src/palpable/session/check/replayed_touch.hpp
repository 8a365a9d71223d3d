// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/hand_off.hpp"
#include "palpable/haptics/servo/tick.hpp"
#include "palpable/session/check/recorded_scenes.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <memory>
#include <optional>

namespace palpable::session {

/// The whole tick of the servo, run offline on a recording's readings: the same pipeline, in the same
/// arithmetic. It can do so from a session's first tick on, as long as no tick is missing and every scene is
/// at hand. One thread.
class ReplayedTouch {
 public:
  ReplayedTouch(const RecordedSession& session, RecordedScenes& scenes);
  ~ReplayedTouch();
  ReplayedTouch(const ReplayedTouch&) = delete;
  ReplayedTouch& operator=(const ReplayedTouch&) = delete;

  /// The hand's next recorded tick, recomputed; null where that cannot be, and from then on: why() says it.
  const device::TouchSample* step(const device::TouchSample& recorded);
  const std::string& why() const { return why_; }
  /// Of what was recomputed.
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

/// The law alone, on the recorded hand, from the first tick of each touch on: what can be recomputed of old
/// recordings and of those that began within a touch. Not while scenes change. One thread.
class ReplayedLaw {
 public:
  explicit ReplayedLaw(RecordedScenes& scenes) : scenes_(scenes) {}

  /// The law's output at the next recorded tick; nothing where it cannot be known.
  std::optional<haptics::LawOutput> step(const device::TouchSample& recorded);

 private:
  RecordedScenes& scenes_;
  haptics::TouchState state_;
  bool known_ = false;
  std::uint32_t scene_id_ = 0;
  std::uint64_t next_tick_ = 0;
};

/// What a law was asked at a recorded tick.
haptics::Hand recorded_hand(const device::TouchSample& recorded, const haptics::HapticScene& scene);

}  // namespace palpable::session
