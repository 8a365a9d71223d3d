// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_parts.hpp"

namespace palpable::session {
namespace {

/// Number of ticks that are written together. This bounds the memory after a long delay.
constexpr std::size_t kTogether = 512;

}  // namespace

void RecordedParts::note(const device::RecordedScene& scene) {
  const std::lock_guard lock(mutex_);
  scenes_.push_back(scene);
}

void RecordedParts::write_to(device::RecordingWriter& writer) {
  do {
    ticks_.clear();
    while (ticks_.size() < kTogether)
      if (const auto sample = take_tick_())
        ticks_.push_back(*sample);
      else
        break;
    // A scene is noted before the servo gets it. So all scenes of these ticks are noted now, but not before
    // they were taken; and a scene is written before its ticks.
    std::vector<device::RecordedScene> noted;
    {
      const std::lock_guard lock(mutex_);
      noted.swap(scenes_);
    }
    for (const auto& scene : noted)
      if (outcome_) outcome_ = writer.write(scene);
    if (outcome_ && !ticks_.empty()) outcome_ = writer.write(ticks_);
  } while (ticks_.size() == kTogether);
}

}  // namespace palpable::session
