// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable {

/// Whether UTF-8 text contains a character that controls a terminal or changes the writing direction: a
/// control character (C0, DEL, C1) other than newline and tab, or a bidirectional override or isolate.
bool has_control_characters(std::string_view text);

/// Replaces each of those characters by a question mark.
std::string without_control_characters(std::string_view text);

}  // namespace palpable
