// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"
#include "palpable/sources/input/input.hpp"

#include <optional>
#include <span>
#include <string>

namespace palpable::cli {

/// A sentence that names the options of `given` ("--size") that have no effect on a scene of this kind from
/// this kind of input, and the `parameters` of --set, which have none either; nullopt if there are none. One
/// table lists which option applies to what. An option that is not in it always has an effect, or is rejected
/// otherwise.
std::optional<std::string> unused_options(std::span<const std::string> given,
                                          std::span<const std::string> parameters, sources::InputKind input,
                                          const models::Model& made);

/// The same of shapes that are fitted to an input.
std::optional<std::string> unused_by_fit_shapes(std::span<const std::string> given);

}  // namespace palpable::cli
