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

/// Places the device's workspace in the scene: it is scaled so that the scene's width and height fit into it,
/// and of a device with three axes the depth into three quarters of it. A scene that already fits is not
/// enlarged. The device's origin is the middle of the scene's box: half-way up a relief.
Transform<SceneFrame, DeviceFrame> fit_workspace(const models::Scene& scene, const device::Traits& device);

/// Starts a servo loop that renders `touchable` (for example with a custom law) on `device`; the scene is
/// fitted into the device's workspace. The stiffness is used as given. session::TouchSession also lowers it
/// to what the device renders stably. Errors: as ServoLoop::start(); a scene without a model (usage).
Result<std::unique_ptr<ServoLoop>> start_touch(const models::Scene& scene,
                                               std::shared_ptr<const Touchable> touchable,
                                               std::unique_ptr<device::Device> device,
                                               const ServoOptions& options = {});

/// The same with one of the library's laws. Errors: as ServoLoop::start() and make_touchable().
Result<std::unique_ptr<ServoLoop>> start_touch(const models::Scene& scene, const LawParameters& law,
                                               std::unique_ptr<device::Device> device,
                                               const ServoOptions& options = {});

}  // namespace palpable::haptics
