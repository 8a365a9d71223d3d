// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"

#include <functional>
#include <string>

namespace palpable::cli {

enum class Speech { off, on };

/// What a touch calls before it opens a device whose handle must be held in some way: says so, aloud with
/// Speech::on, and at a terminal waits for Enter, or until the program is interrupted. Without a terminal it
/// does not wait.
std::function<void(const std::string& sentence)> ask_to_hold(Speech speech, Console& console);

/// Waits until a line, or the end, comes from this descriptor, or the program is interrupted.
void wait_for_line(int descriptor);

}  // namespace palpable::cli
