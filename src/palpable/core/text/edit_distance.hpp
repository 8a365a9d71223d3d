// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace palpable {

/// Longer than any name that a person types.
inline constexpr std::size_t kLongestCompared = 1000;

/// Fewest insertions, deletions and changes of one byte, and exchanges of two neighbours, that make one text
/// from the other (optimal string alignment distance). The time is proportional to the product of the
/// lengths, so texts of more than kLongestCompared bytes are not compared byte by byte: unless they are
/// equal, their distance is the length of the longer one. Any thread.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace palpable
