// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"

#include <string_view>

namespace palpable::cli {

/// Speaks with the person's own voice and waits for its end; a note says why where nothing can speak.
void say_aloud(std::string_view sentence, Console& console);

}  // namespace palpable::cli
