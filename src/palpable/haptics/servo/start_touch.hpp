// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>

namespace palpable::haptics {

/// The device's workspace laid over the scene: centred on it, and scaled so that the scene's width and height
/// fit into the device's; a scene that fits is never enlarged.
Transform<SceneFrame, DeviceFrame> fit_workspace(const models::Scene& scene, const device::Traits& device);

/// A touch with a law of your own: starts a servo loop that renders `touchable` on `device`, the scene fitted
/// into the device's workspace. The caller's stiffness is used as it is: session::TouchSession also lowers it
/// to what the device renders stably. Errors: as ServoLoop::start().
Result<std::unique_ptr<ServoLoop>> start_touch(const models::Scene& scene,
                                               std::shared_ptr<const Touchable> touchable,
                                               std::unique_ptr<device::Device> device,
                                               const ServoOptions& options = {});

/// The same with one of the library's laws. Errors: also as make_touchable().
Result<std::unique_ptr<ServoLoop>> start_touch(const models::Scene& scene, const LawParameters& law,
                                               std::unique_ptr<device::Device> device,
                                               const ServoOptions& options = {});

}  // namespace palpable::haptics
