// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/numerals.hpp"

#include <algorithm>
#include <cctype>

namespace palpable::vision {
namespace {

/// Whether a word has two or three upright strokes and nothing else.
bool has_strokes_only(std::string_view word) {
  constexpr std::string_view kStrokes = "Ili1|";
  return (word.size() == 2 || word.size() == 3) &&
         std::all_of(word.begin(), word.end(), [&](char c) { return kStrokes.find(c) != kStrokes.npos; }) &&
         word.find_first_of("Ili") != word.npos;
}

}  // namespace

std::string with_numerals(std::string_view words) {
  const std::size_t blank = words.rfind(' ');
  if (blank == words.npos || blank == 0) return std::string(words);
  const std::size_t before = words.substr(0, blank).rfind(' ');
  const auto first = static_cast<unsigned char>(words[before == words.npos ? 0 : before + 1]);
  const std::string_view last = words.substr(blank + 1);
  const std::string start(words.substr(0, blank + 1));
  if (std::isupper(first) != 0 && has_strokes_only(last)) return start + std::string(last.size(), 'I');
  if (std::isupper(first) != 0 && (last == "ler" || last == "Ler" || last == "Ier")) return start + "1er";
  return std::string(words);
}

}  // namespace palpable::vision
