// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace palpable {

// Parses numbers, independently of the locale. The whole text must be one number, without spaces or a unit.
// nullopt for anything else: empty, NaN, infinite, outside the type's range.

/// A decimal number with optional sign and exponent.
std::optional<double> finite_number(std::string_view text);

/// Decimal digits with an optional sign.
std::optional<std::int64_t> whole_number(std::string_view text);

}  // namespace palpable
