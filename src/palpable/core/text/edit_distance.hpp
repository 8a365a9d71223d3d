// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace palpable {

/// Fewest insertions, deletions and changes of one byte, and exchanges of two neighbours, that make one text
/// from the other (optimal string alignment distance). Any thread.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace palpable
