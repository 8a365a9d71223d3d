// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <vector>

namespace palpable::page {

/// The laws that the scene can be touched with, the default first, with the parameters that a slider offers.
protocol::Laws page_laws(const models::Scene& scene);

/// The parameters of `law` as they are set in `parameters`, and the values in use: where none is set, the
/// first material's, the model's or the law's own.
std::vector<protocol::ParameterValue> parameter_values(const models::Scene& scene, haptics::Law law,
                                                       const haptics::LawParameters& parameters);

/// `before` with the law and its parameters as a page requests them; those that are not listed are not set.
/// Errors: usage for a law or a parameter that does not exist.
Result<haptics::LawParameters> requested_parameters(const haptics::LawParameters& before,
                                                    const protocol::Change& change);

}  // namespace palpable::page
