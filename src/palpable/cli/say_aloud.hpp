// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"

#include <string_view>

namespace palpable::cli {

/// Speaks a sentence with the user's speech settings and waits until it ends. If no speech output is
/// available, a note gives the reason.
void say_aloud(std::string_view sentence, Console& console);

}  // namespace palpable::cli
