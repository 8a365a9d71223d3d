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

/// A name as it is shown and spoken: without those characters, newlines and tabs as blanks, no blanks at its
/// ends and no two in a row. Empty for a text of blanks.
std::string plain_name(std::string_view text);

/// Whether a text is UTF-8: no byte that is out of place, no overlong form, no surrogate.
bool is_utf8(std::string_view text);

/// A text as editors on other systems save it: without a byte order mark, lines ended by a newline alone.
std::string with_plain_lines(std::string_view text);

}  // namespace palpable
