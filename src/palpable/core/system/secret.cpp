// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/secret.hpp"

#include <array>
#include <cstddef>

#include <sys/random.h>

namespace palpable {

Result<std::string> random_secret() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    return Error{ErrorCode::failed, "the system's random bytes for a token cannot be read", {}};
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) {
    text.push_back(kDigits[byte >> 4U]);
    text.push_back(kDigits[byte & 15U]);
  }
  return text;
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size() || a.empty()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

std::string SessionAccess::exchange(std::string_view token) {
  if (used_ || !same_secret(token, token_)) return {};
  used_ = true;
  return secret_;
}

}  // namespace palpable
