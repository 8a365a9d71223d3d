// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/text/figure.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

// Formats numbers for people. All sentences and tables use these functions.

namespace palpable::describe {

/// A length to read: "110 mm", "3.4 mm", "0.25 mm"; from one metre on "1.25 m".
std::string length(double metres);
/// A length to hear, to a tenth of a millimetre below ten: "110 millimetres", "1 millimetre", "minus 2.5
/// millimetres"; from one metre on "1.25 metres".
std::string spoken_length(double metres);
/// Two lengths with one unit where both have it: "1 to 13 millimetres", "100 by 75 millimetres".
std::string spoken_lengths(double first_m, std::string_view between, double second_m);
/// "0.25 newtons", "1 newton".
std::string spoken_force(double newtons);
/// Without sign: "15 degrees", "1 degree".
std::string spoken_angle(double radians);

/// "no lines", "1 line", "3 lines": singular and plural are messages (language.hpp), as `between` is.
std::string counted(std::size_t count, std::string_view singular, std::string_view plural);
/// "a", "a and b", "a, b and c".
std::string listed(std::span<const std::string> words);
/// With its first letter (of Latin-1) as a capital.
std::string capitalised(std::string sentence);

}  // namespace palpable::describe
