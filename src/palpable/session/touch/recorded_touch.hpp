// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/servo/servo_types.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/touch/scene_hash.hpp"
#include "palpable/session/touch/touch_settings.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace palpable::session {

/// What a recording holds of what was touched from a tick on: with the scene, all that its forces are made
/// of.
struct RecordedTouch {
  /// As felt, with the materials below; and what the person asked for, before the device's limits.
  haptics::LawParameters law;
  haptics::LawParameters asked_for;
  /// Of a relief.
  double depth = 1.0;
  haptics::TransientKind transient = haptics::TransientKind::none;
  /// One for each of the scene's; of a texture from a picture the forms are the scene's.
  std::vector<models::Material> materials;
  Transform<SceneFrame, DeviceFrame> scene_from_device;
  /// The shape's is empty in recordings of format 1.
  SceneHash hashes;
  /// models::Scene::source.
  std::vector<std::string> inputs;
  std::string method;
};

/// One JSON object (docs/recording.md); numbers come back to the last bit.
std::string touch_json(const RecordedTouch& touch);
/// Errors (invalid_input), without a place: not such an object, a law or a parameter that there is not.
Result<RecordedTouch> parse_touch(const std::string& json);

/// Whether `hash` is of the scene that was touched, materials aside where the recording says so.
bool is_of(const RecordedTouch& touch, const SceneHash& hash);

/// What the servo rendered then, made again of the scene. Errors: usage, where the scene does not fit.
Result<haptics::HapticScene> remade_scene(const RecordedTouch& touch, const models::Scene& scene,
                                          std::uint32_t id, haptics::DilatedRelief& kept);

}  // namespace palpable::session
