// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/compared_form.hpp"

#include <cctype>
#include <cstddef>

namespace palpable::vision {

std::string compared_form(std::string_view name) {
  // The base letters of U+00C0 ... U+00FF, in UTF-8 0xC3 and 0x80 ... 0xBF.
  constexpr std::string_view kBase = "aaaaaaaceeeeiiiidnooooo\0ouuuuytsaaaaaaaceeeeiiiidnooooo\0ouuuuyty";
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (c < 0x80) {
      if (std::isalnum(c) != 0) out += static_cast<char>(std::tolower(c));
      continue;
    }
    const bool is_latin = c == 0xC3 && i + 1 < name.size();
    if (is_latin) {
      const auto at = static_cast<std::size_t>(static_cast<unsigned char>(name[++i]) & 0x3FU);
      const char base = std::string_view(kBase.data(), 64)[at];
      if (base == '\0') continue;
      // The sharp s is two letters.
      out += at == 0x1F ? std::string("ss") : std::string(1, base);
      continue;
    }
    const bool is_mark = c == 0xE2 && i + 2 < name.size() && static_cast<unsigned char>(name[i + 1]) == 0x80;
    if (is_mark) {
      i += 2;
      continue;
    }
    out += name[i];
  }
  return out;
}

}  // namespace palpable::vision
