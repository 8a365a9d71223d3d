// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/suggest.hpp"

#include "palpable/core/text/edit_distance.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace palpable::cli {

std::optional<std::string> suggestion(std::string_view typed, std::span<const std::string> known) {
  // An abbreviation of one word alone.
  constexpr std::size_t kShortest = 4;
  const auto begins = [typed](const std::string& word) { return word.starts_with(typed); };
  if (typed.size() >= kShortest && std::count_if(known.begin(), known.end(), begins) == 1)
    return *std::find_if(known.begin(), known.end(), begins);
  std::optional<std::string> best;
  std::size_t fewest = std::max<std::size_t>(1, typed.size() / 3) + 1;
  for (const std::string& word : known) {
    // The difference of lengths alone may be too large.
    if (std::max(word.size(), typed.size()) - std::min(word.size(), typed.size()) >= fewest) continue;
    const std::size_t edits = edit_distance(typed, word);
    if (edits < fewest) {
      fewest = edits;
      best = word;
    }
  }
  return best;
}

std::string unknown_word(std::string_view typed, std::span<const std::string> known) {
  if (std::find(known.begin(), known.end(), typed) != known.end()) return {};
  std::string sentence = fmt::format("'{}' is not one of {}", typed, fmt::join(known, ", "));
  if (const auto meant = suggestion(typed, known)) sentence += fmt::format("; did you mean {}?", *meant);
  return sentence;
}

}  // namespace palpable::cli
