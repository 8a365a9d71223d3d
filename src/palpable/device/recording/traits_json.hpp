// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <optional>
#include <string>

namespace palpable::device {

/// Traits as one JSON object, names and units as the members'; null where unknown or unbounded. Every number
/// comes back to the last bit.
std::string traits_json(const Traits& traits);

/// Those in the member "traits" of a recording's header; nothing where there are none, as in recordings of
/// format 1, or where a value is not one.
std::optional<Traits> recorded_traits(const std::string& header_json);

}  // namespace palpable::device
