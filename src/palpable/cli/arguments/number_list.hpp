// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace palpable::cli {

/// Parses exactly `count` numbers separated by commas, colons, semicolons or spaces. Errors: usage, naming
/// the option, with an example of how they are written.
Result<std::vector<double>> numbers_of(const std::string& text, std::size_t count, const char* option,
                                       const char* example);

}  // namespace palpable::cli
