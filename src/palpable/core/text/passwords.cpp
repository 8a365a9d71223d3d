// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/passwords.hpp"

#include <algorithm>

namespace palpable {

std::string without_passwords(std::string_view text) {
  constexpr std::string_view kMark = "://";
  std::string shown;
  while (true) {
    const auto mark = text.find(kMark);
    if (mark == std::string_view::npos) return shown.append(text);
    const auto begin = mark + kMark.size();
    shown.append(text.substr(0, begin));
    text.remove_prefix(begin);
    // An address may contain the next one, whose name and password are its own.
    const auto end = std::min(text.find_first_of(" \t\r\n\"'"), text.find(kMark));
    const auto at = text.substr(0, end).rfind('@');
    if (at != std::string_view::npos) text.remove_prefix(at + 1);
  }
}

}  // namespace palpable
