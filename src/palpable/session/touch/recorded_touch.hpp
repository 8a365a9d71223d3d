// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/touch/scene_hash.hpp"
#include "palpable/session/touch/touch_settings.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpable::session {

/// A recording's description of what was touched from a tick on. With the scene it determines all forces.
struct RecordedTouch {
  /// The law in use, with the materials below; and the requested one, before the device's limits.
  haptics::LawParameters law;
  haptics::LawParameters asked_for;
  /// Height factor of a relief.
  double height_factor = 1.0;
  haptics::TransientKind transient = haptics::TransientKind::none;
  /// One for each of the scene's; of a texture from a picture the forms are the scene's.
  std::vector<models::Material> materials;
  /// models::Scene::guide.
  std::optional<models::RouteGuide> guide;
  Transform<SceneFrame, DeviceFrame> scene_from_device;
  /// The shape's hash is empty in recordings of format 1.
  SceneHash hashes;
  /// models::Scene::source.
  std::vector<std::string> inputs;
  std::string method;
};

/// The description as one JSON object (docs/recording.md); numbers are restored to the last bit.
std::string touch_json(const RecordedTouch& touch);
/// Reads the JSON of touch_json(). Errors (invalid_input), without a place: another kind of object, an
/// unknown law or parameter.
Result<RecordedTouch> parse_touch(const std::string& json);

/// Whether `hash` belongs to the touched scene. Materials are ignored if the recording contains them.
bool is_of(const RecordedTouch& touch, const SceneHash& hash);

/// Rebuilds what the servo rendered from the scene. Errors: usage if the scene does not fit.
Result<haptics::HapticScene> remade_scene(const RecordedTouch& touch, const models::Scene& scene,
                                          std::uint32_t id, haptics::DilatedRelief& kept);

}  // namespace palpable::session
