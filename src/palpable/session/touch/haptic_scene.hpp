// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/tick/servo_types.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/touch/touch_settings.hpp"

#include <string>
#include <vector>

namespace palpable::session {

/// What the servo renders, and how it differs from what was requested.
struct PreparedScene {
  haptics::HapticScene scene;
  /// The law in use. Its stiffness and damping are in `materials`.
  haptics::LawParameters law;
  /// The materials in use: as requested, limited to what the device can render.
  std::vector<models::Material> materials;
  /// As rendered.
  haptics::TransientKind transient = haptics::TransientKind::none;
  /// One sentence for each value that the device's limits changed.
  std::vector<std::string> notices;
};

/// The scene with its height multiplied by `height_factor`. Errors (usage): a factor outside -4 ... 4, or not
/// 1 for a scene that is not a relief.
Result<models::Scene> with_height_factor(const models::Scene& scene, double height_factor);

/// The scene with other materials. Errors (usage): another number of materials than the scene has, or a value
/// out of its range.
Result<models::Scene> with_materials(const models::Scene& scene, std::vector<models::Material> materials);

/// Results of expensive preparation of a scene, reused for all changes during one touch. Empty at first.
struct KeptSurfaces {
  std::shared_ptr<const models::Relief> of;
  double height_factor = 1.0;
  std::shared_ptr<const models::Relief> scaled;
  haptics::DilatedRelief dilated;
};

/// Prepares a law on a scene for a device. Stiffness is limited to what the device can render at that rate
/// (haptics/safety/stability.hpp). If only parameters changed, the surface is taken from `kept`. Long work:
/// reports progress, polls cancel. Errors: as make_touchable() and with_height_factor().
Result<PreparedScene> prepare_scene(const models::Scene& scene, const TouchSettings& settings,
                                    const device::Traits& device, double rate_hz,
                                    const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                                    KeptSurfaces& kept, const Work& work = {});

}  // namespace palpable::session
