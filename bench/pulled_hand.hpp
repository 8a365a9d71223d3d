// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/models/scene/scene.hpp"

// A simulated hand that only presses, and is led by the pull along a route. It is a model and no evidence
// about people.
namespace palpable::bench {

/// Where a hand of 100 g ends that presses with 0.6 N on a scene with a guide, has an arm's damping of 3
/// N·s/m, and steers nothing itself; it begins at the guide's beginning. `most_made_J`: raised to the energy
/// that was generated beyond the guide's reserve. `kept`: as make_touchable().
describe::Place pulled_hand(const models::Scene& scene, haptics::DilatedRelief& kept, double& most_made_J);

}  // namespace palpable::bench
