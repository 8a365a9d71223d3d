// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/session/make/maker_thread.hpp"
#include "palpable/session/touch/live_feed.hpp"
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
  /// Duration of the touch, from the first scene on.
  double seconds = 10.0;
  /// Empty = no recording.
  std::filesystem::path recording;
  /// For simulated devices alone: the best scene is waited for, ticks count as time
  /// (haptics::ServoOptions::time_by_ticks), and the touch has as many as `seconds` hold, so that the same
  /// seed gives the same touch. Not with `live` or a walk, which follow the clock.
  bool repeatable = false;
  /// CLOCK_MONOTONIC at the user's request, ns; 0 = now.
  std::int64_t begin_ns = 0;
  /// Feeds the touch with the frames of a live source; not owned, null = none.
  LiveFeed* live = nullptr;
  /// The walk of an explorer, in seconds from the first scene; empty = the exocentric view.
  std::vector<WalkStep> walk;
  /// Called for each step of the walk when it is taken; may be empty.
  std::function<void(const ExplorerPose&)> on_pose;
  /// Called for each sentence about changes due to the device's limits, at the start and with each better
  /// scene, and about the live source, by its thread; may be empty.
  std::function<void(const std::string&)> on_notice;
  /// Called for each sentence about a hand's device: what the person does next, that it does not answer and
  /// that it answers again (then `tells_of_force`), and what its clutch does; may be empty.
  std::function<void(const std::string& sentence, bool tells_of_force)> on_device;
  /// Called for each missed deadline; may be empty.
  std::function<void(const haptics::MissedDeadline&)> on_missed;
  /// Called for each event, with the touched scene, shortly after it happened; may be empty.
  std::function<void(const haptics::TouchEvent&, const models::Scene&)> on_event;
};

/// Runs a touch without the page: waits for the first scene, touches it for the given time, and replaces it
/// by better scenes as they arrive. If work is cancelled during the touch, it ends early with the statistics
/// so far. Errors: the maker's if there was no scene; the session's and the recording's; interrupted before
/// the first scene.
Result<TouchStatistics> touch_headless(const SceneMaker& maker, const HeadlessOptions& options,
                                       const Work& work);

}  // namespace palpable::session
