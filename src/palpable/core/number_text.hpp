// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace palpable {

// Numbers that people and files write, whatever the locale. The whole text must be one number: no blanks, no
// unit. nullopt for anything else: empty, NaN, infinite, beyond the type's range.

/// Decimal, with an exponent or without, and with a sign or without.
std::optional<double> finite_number(std::string_view text);

/// Decimal digits, with a sign or without.
std::optional<std::int64_t> whole_number(std::string_view text);

}  // namespace palpable
