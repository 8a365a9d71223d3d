// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable {

/// Whether UTF-8 text holds a character that acts on a terminal or turns the direction of writing: a control
/// character other than a line's end and a tab (C0, DEL, C1), or a bidirectional override or isolate.
bool has_control_characters(std::string_view text);

/// The text with a question mark for each of those.
std::string without_control_characters(std::string_view text);

}  // namespace palpable
