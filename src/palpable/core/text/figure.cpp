// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palpable {

std::string figure(double value, int digits) {
  if (!std::isfinite(value)) return "unknown";
  constexpr double kNothing = 1e-9;
  if (std::abs(value) < kNothing) return "0";
  const auto before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  const int after = std::max(digits - before, 0);
  const int length = std::snprintf(nullptr, 0, "%.*f", after, value);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::snprintf(text.data(), text.size() + 1, "%.*f", after, value);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace palpable
