// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/session/make/maker_thread.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace palpable::session {

struct HeadlessOptions {
  TouchSettings settings;
  SessionOptions session;
  std::string device_url = "sim:";
  /// Counted from the first scene.
  double seconds = 10.0;
  /// Empty = no recording.
  std::filesystem::path recording;
  /// CLOCK_MONOTONIC when the person asked; 0 = now.
  std::int64_t begin_ns = 0;
  /// How an explorer goes, seconds from the first scene on; empty = the exocentric view.
  std::vector<WalkStep> walk;
  /// For each place where the explorer stands, as they come there; may be empty.
  std::function<void(const Stance&)> on_stance;
  /// For each sentence on what the device's limits changed, at the beginning and with each better scene; may
  /// be empty.
  std::function<void(const std::string&)> on_notice;
  /// For each missed deadline, as it is found; may be empty.
  std::function<void(const haptics::MissedDeadline&)> on_missed;
  /// For each event, with the scene that was touched; a look later than it happened; may be empty.
  std::function<void(const haptics::TouchEvent&, const models::Scene&)> on_event;
};

/// A touch without page: waits for the first scene, touches it for the time given, takes better scenes in as
/// they come. Ends early, with what it measured so far, when work is cancelled during the touch. Errors: the
/// maker's if no scene came; the session's and the recording's; interrupted before the first scene.
Result<TouchStatistics> touch_headless(const SceneMaker& maker, const HeadlessOptions& options,
                                       const Work& work);

}  // namespace palpable::session
