// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/name_order.hpp"

#include <cctype>
#include <cstddef>

namespace palpable {
namespace {

bool is_decimal(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The number that begins at `at`, without leading zeros; moves `at` behind it.
std::string_view number_at(std::string_view name, std::size_t& at) {
  while (at + 1 < name.size() && name[at] == '0' && is_decimal(name[at + 1])) ++at;
  const std::size_t begin = at;
  while (at < name.size() && is_decimal(name[at])) ++at;
  return name.substr(begin, at - begin);
}

}  // namespace

bool counted_before(std::string_view a, std::string_view b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_decimal(a[i]) && is_decimal(b[j])) {
      const std::string_view left = number_at(a, i);
      const std::string_view right = number_at(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

}  // namespace palpable
