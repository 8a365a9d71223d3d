// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace palpable {

/// A number as text with `digits` significant digits, but always with all digits before the decimal point;
/// without exponent, trailing zeros of the fraction or "-0": "110", "3.4", "0.25". Magnitudes below 1e-9 give
/// "0"; values that are not finite give "unknown".
std::string figure(double value, int digits = 2);

}  // namespace palpable
