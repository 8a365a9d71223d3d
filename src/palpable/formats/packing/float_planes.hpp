// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// Floats in a form that any compressor makes small: differences of neighbours, as four planes of bytes, the
/// lowest first. `row`: values of one row, >= 1; a row begins with the difference to the row above. Exact for
/// every bit pattern.
std::vector<std::byte> planes_of(std::span<const float> values, std::size_t row);

/// The reverse. The size of `planes` must be a multiple of four.
std::vector<float> floats_of(std::span<const std::byte> planes, std::size_t row);

}  // namespace palpable::formats
