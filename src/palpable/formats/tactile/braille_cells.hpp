// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::formats {

/// A cell of six-dot braille: dots 1 to 6 as bits 0 to 5.
using BrailleCell = std::uint8_t;
using BrailleLine = std::vector<BrailleCell>;

/// The cell in North American braille ASCII, as embossers read it.
char braille_ascii(BrailleCell cell);
std::string braille_ascii(std::span<const BrailleCell> line);

/// Uncontracted braille of a text without a translation program: ASCII letters, capitals with their sign,
/// digits with the number sign, common marks; any other character is dots 3456 and 6.
BrailleLine plain_braille(std::string_view text);

/// Whether liblouis has a table of this name. Errors, without a place: usage, with the names of those of its
/// language, or the languages that there are. Also no error where no tables are found at all: then liblouis
/// itself decides.
Result<void> check_braille_table(const std::string& table);

/// Translates lines (UTF-8) with liblouis, by its program `lou_translate` and one of its tables, as
/// "en-ueb-g1.ctb" or "de-g1.ctb". Dots 7 and 8 are left out. Errors, without a place: usage for a name that
/// is no table's; failed if the program is not installed, does not know the table or takes longer than ten
/// seconds.
Result<std::vector<BrailleLine>> translated_braille(std::span<const std::string> lines,
                                                    const std::string& table);

/// Which of the lines hold only characters that a table of liblouis knows; it writes others by their number
/// in hexadecimal. Errors: as translated_braille().
Result<std::vector<bool>> writable_in_braille(std::span<const std::string> lines, const std::string& table);

}  // namespace palpable::formats
