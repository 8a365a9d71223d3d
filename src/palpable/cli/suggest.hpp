// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace palpable::cli {

/// The known word that was most likely meant by `typed`: the only one that begins so (four characters or
/// more), else that of fewest insertions, deletions, changes and swaps of neighbours, at most one for every
/// three letters (and at least one). nullopt if none is that close.
std::optional<std::string> suggestion(std::string_view typed, std::span<const std::string> known);

/// The sentence for a word that is not known: "'sectoin' is not one of relief, section; did you mean
/// section?". Empty for a known word.
std::string unknown_word(std::string_view typed, std::span<const std::string> known);

}  // namespace palpable::cli
