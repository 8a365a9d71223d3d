// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/haptics/servo/probe_path.hpp"
#include "palpable/models/scene/scene.hpp"

#include <vector>

namespace palpable::cli {

/// The built-in solid of `bench`: two intersecting balls, 100 mm long, as a field of 512 cells.
Result<models::Scene> own_field_scene(const Work& work);

/// A path around both balls, half a millimetre below the surface.
std::vector<haptics::PathSample> own_field_path(const models::DistanceField& field);

/// Times only the evaluation of distance and gradient at each sample of the path.
haptics::TickTimes time_samples(const models::DistanceField& field,
                                std::span<const haptics::PathSample> path);

}  // namespace palpable::cli
