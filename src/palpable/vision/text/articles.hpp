// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace palpable::vision {

/// What was read, with the French article in its words: after "de", "Ja", "Ia", "1a" and "fa" are "la", and a
/// word that begins with "I'" or "1'" begins with "l'". UTF-8; blanks between words.
std::string with_articles(std::string_view words);

}  // namespace palpable::vision
