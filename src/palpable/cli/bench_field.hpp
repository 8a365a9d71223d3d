// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/haptics/servo/probe_path.hpp"
#include "palpable/models/scene/scene.hpp"

#include <vector>

namespace palpable::cli {

/// Our own solid for `bench`: two balls that meet in a crease, 100 mm long, as a field of 512 cells.
Result<models::Scene> own_field_scene(const Work& work);

/// Round both balls, half a millimetre under the surface.
std::vector<haptics::PathSample> own_field_path(const models::DistanceField& field);

/// Distance and gradient at each sample of the path, and nothing else.
haptics::TickTimes time_samples(const models::DistanceField& field,
                                std::span<const haptics::PathSample> path);

}  // namespace palpable::cli
