// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/touch/recorded_touch.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// The scenes of a recording: what it states about each touch, and the haptic scene rebuilt from the scene
/// files at hand. Only the scenes that may still be needed are kept: ticks refer to scenes in increasing
/// order. One thread.
class RecordedScenes {
 public:
  explicit RecordedScenes(const std::vector<std::shared_ptr<const models::Scene>>& at_hand);

  /// Adds the description of a touch. Errors: as parse_touch().
  Result<void> note(std::uint32_t id, const std::string& json);
  /// The description of a touch; null if the recording contains none.
  const RecordedTouch* touch(std::uint32_t id) const;
  /// The rebuilt scene; null if it is not available or cannot be made, with the reason in why(). Valid until
  /// forget_before() with a later id.
  const haptics::HapticScene* scene(std::uint32_t id);
  void forget_before(std::uint32_t id);
  const std::string& why() const { return why_; }

 private:
  struct AtHand {
    std::shared_ptr<const models::Scene> scene;
    SceneHash hash;
  };
  struct Noted {
    RecordedTouch touch;
    std::unique_ptr<const haptics::HapticScene> made;
    bool tried = false;
  };
  const models::Scene* find(const RecordedTouch& touch) const;

  std::vector<AtHand> at_hand_;
  std::map<std::uint32_t, Noted> noted_;
  haptics::DilatedRelief kept_;
  std::string why_;
};

}  // namespace palpable::session
