// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace palpable {

/// `digits` significant digits, and never fewer than stand before the decimal point; without exponent,
/// without zeros at the end of the fraction, without "-0": "110", "3.4", "0.25". What is smaller than 1e-9 is
/// "0"; what is not finite is "unknown".
std::string figure(double value, int digits = 2);

}  // namespace palpable
