// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable::vision {

/// What was read, with the numbers of rulers in its last word that are read as letters: after a name (a word
/// with a capital), "Il" and "Ill" are "II" and "III", "ler" is "1er". UTF-8; blanks between words.
std::string with_numerals(std::string_view words);

}  // namespace palpable::vision
