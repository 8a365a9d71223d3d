// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/recording/recording.hpp"

#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace palpable::session {

/// The parts of a recording that are not written yet: ticks, which one thread takes from the servo's ring,
/// and descriptions of scenes, which any thread notes before the servo gets the scene. A scene is always
/// written before its ticks.
class RecordedParts {
 public:
  /// `take_tick` gives the next recorded tick, or nullopt if there is none now.
  explicit RecordedParts(std::function<std::optional<device::TouchSample>()> take_tick)
      : take_tick_(std::move(take_tick)) {}

  /// Any thread.
  void note(const device::RecordedScene& scene);
  /// Writes what there is. One thread. After an error ticks and scenes are taken, but no longer written.
  void write_to(device::RecordingWriter& writer);
  /// The first error of writing.
  const Result<void>& outcome() const { return outcome_; }

 private:
  std::function<std::optional<device::TouchSample>()> take_tick_;
  std::mutex mutex_;
  std::vector<device::RecordedScene> scenes_;
  // Used only by the writing thread.
  std::vector<device::TouchSample> ticks_;
  Result<void> outcome_;
};

}  // namespace palpable::session
