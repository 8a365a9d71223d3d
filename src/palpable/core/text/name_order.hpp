// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace palpable {

/// Natural order of names: digits are compared as numbers, so frame-2 is before frame-10.
bool counted_before(std::string_view a, std::string_view b);

}  // namespace palpable
