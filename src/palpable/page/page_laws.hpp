// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <vector>

namespace palpable::page {

/// The laws that support the scene, the default first, with their slider parameters. Laws that this device
/// cannot render are marked.
protocol::Laws page_laws(const models::Scene& scene, const device::Traits& device);

/// The parameters of `law` with their values in `parameters` and the effective values: if one is not set,
/// that of the first material, the model or the law.
std::vector<protocol::ParameterValue> parameter_values(const models::Scene& scene, haptics::Law law,
                                                       const haptics::LawParameters& parameters);

/// `before` with the law and the parameters that a page requests; parameters that are not listed become
/// unset. Errors: usage for a law or a parameter that does not exist.
Result<haptics::LawParameters> requested_parameters(const haptics::LawParameters& before,
                                                    const protocol::Change& change);

}  // namespace palpable::page
