// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/number_list.hpp"

#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace palpable::cli {

Result<std::vector<double>> numbers_of(const std::string& text, std::size_t count, const char* option,
                                       const char* example) {
  const Error wrong{ErrorCode::usage,
                    fmt::format("'{}' are not {} numbers: write them as {}", text, count, example), option};
  std::vector<double> numbers;
  std::string_view rest = text;
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" ,;:"), rest.size()));
    if (rest.empty()) break;
    const std::string_view word = rest.substr(0, rest.find_first_of(" ,;:"));
    const auto value = finite_number(word);
    if (!value) return wrong;
    numbers.push_back(*value);
    rest.remove_prefix(word.size());
  }
  if (numbers.size() != count) return wrong;
  return numbers;
}

}  // namespace palpable::cli
