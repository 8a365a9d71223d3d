// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"
#include "palpable/page/host.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace palpable::page {

/// The page's view of a scene: heights of the touched surface, at most 640 along the longer side. Models
/// without a height at each place show a level surface at their base.
std::shared_ptr<const PageScene> page_scene(const models::Scene& scene, std::uint32_t number,
                                            const std::string& name);

/// Height of the surface at a place at a height factor of 1; 0 for models without heights.
double surface_height_m(const models::Scene& scene, double x_m, double y_m);

/// The name that a user gave the material; nullopt if none did.
std::optional<std::string> own_name(const models::Material& material);

}  // namespace palpable::page
