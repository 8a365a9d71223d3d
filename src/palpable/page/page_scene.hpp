// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"
#include "palpable/page/host.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace palpable::page {

/// The page's view of a scene: heights of the touched surface, at most 640 along the longer side. Models
/// without a height at each place show a level surface at their base.
std::shared_ptr<const PageScene> page_scene(const models::Scene& scene, std::uint32_t number,
                                            const std::string& name);

}  // namespace palpable::page
