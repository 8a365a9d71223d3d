// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/text/plain_text.hpp"

#include <string>
#include <utility>

namespace palpable::device {

/// Names and sentences of a vendor's library or service are shown, spoken and recorded, so only short plain
/// texts are used: UTF-8 without control characters, at most 64 bytes.
inline bool can_be_shown(const std::string& text) {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest && is_utf8(text) && plain_name(text) == text;
}

/// A text of a C library, which may be null; `otherwise` if it cannot be shown.
inline std::string vendor_text(const char* text, std::string otherwise) {
  std::string given = text == nullptr ? std::string() : text;
  return can_be_shown(given) ? given : std::move(otherwise);
}

/// The greatest force of a device as its library states it, N, within what a force option may say;
/// `otherwise` if it states none.
inline double vendor_force_N(double stated_N, double otherwise_N) {
  constexpr double kMost_N = 40.0;
  return stated_N > 0.0 && stated_N <= 250.0 ? (stated_N < kMost_N ? stated_N : kMost_N) : otherwise_N;
}

}  // namespace palpable::device
