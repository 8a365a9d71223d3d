// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <optional>
#include <string>

namespace palpable::device {

/// Traits as one JSON object, with the members' names and units; null = unknown or unlimited. All numbers are
/// restored to the last bit.
std::string traits_json(const Traits& traits);

/// The traits in the member "traits" of a recording's header; nullopt if it is missing, as in recordings of
/// format 1, or has an invalid value.
std::optional<Traits> recorded_traits(const std::string& header_json);

}  // namespace palpable::device
