// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/touch_sample.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/protocol.gen.hpp"

namespace palpable::page {

/// Height of the surface at a place at a height factor of 1; 0 for models without heights.
double surface_height_m(const models::Scene& scene, double x_m, double y_m);

/// A probe in its newest tick, as the page shows it.
protocol::ProbeState probe_state(const device::TouchSample& sample, const models::Scene& scene,
                                 double height_factor);

/// A device's own positions in the scene, as the page shows them.
protocol::DevicePlace device_place(const Transform<SceneFrame, DeviceFrame>& scene_from_device);

/// Whether two states are equal for a user, whatever their time and rate: probes and device within a
/// micrometre, two millinewtons and a hundredth of a degree.
bool nearly_equal(const protocol::State& a, const protocol::State& b);

/// Where a page's pointer holds the probe: the centre of the touching ball, which at rest is one radius above
/// the surface.
Point<SceneFrame> pointer_place(const protocol::Pointer& pointer, const models::Scene& scene,
                                double height_factor, double radius_m);

}  // namespace palpable::page
