// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/articles.hpp"

#include <algorithm>
#include <array>

namespace palpable::vision {

std::string with_articles(std::string_view words) {
  static constexpr std::array<std::string_view, 4> kLa{"Ja", "Ia", "1a", "fa"};
  std::string out;
  std::string_view before;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    const std::string_view word = words.substr(0, end);
    words.remove_prefix(std::min(end + 1, words.size()));
    const bool is_la = before == "de" && std::find(kLa.begin(), kLa.end(), word) != kLa.end();
    const bool is_elided = word.size() > 2 && (word[0] == 'I' || word[0] == '1') && word[1] == '\'';
    out += out.empty() ? "" : " ";
    out += is_la ? "la" : std::string(word);
    if (is_elided) out[out.size() - word.size()] = 'l';
    before = word;
  }
  return out;
}

}  // namespace palpable::vision
