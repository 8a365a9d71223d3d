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

/// What a recording says was touched, and what the servo rendered then, made again of the scenes that are at
/// hand. Keeps what may still be asked for: ticks name scenes in rising order. One thread.
class RecordedScenes {
 public:
  explicit RecordedScenes(const std::vector<std::shared_ptr<const models::Scene>>& at_hand);

  /// Errors: as parse_touch().
  Result<void> note(std::uint32_t id, const std::string& json);
  /// Null where the recording says nothing of it.
  const RecordedTouch* touch(std::uint32_t id) const;
  /// The scene made again; null where it is not at hand or cannot be made, and why() says it. Valid until
  /// forget_before(): a later id.
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
