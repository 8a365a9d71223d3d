// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <utility>
#include <vector>

namespace palpable {

/// A whole number from JSON that comes from outside; `Json` is nlohmann::json or a variant of it. Other
/// values, also 1.5, 1e77 and numbers out of the range of `Integer`, throw its type_error. (Its own
/// conversion is undefined for large numbers with an exponent, and takes the lowest bits of large ones
/// without.)
template <std::integral Integer, class Json>
Integer integer_from(const Json& json) {
  if (json.is_number_unsigned()) {
    const auto value = json.template get<std::uint64_t>();
    if (std::in_range<Integer>(value)) return static_cast<Integer>(value);
  } else if (json.is_number_integer()) {
    const auto value = json.template get<std::int64_t>();
    if (std::in_range<Integer>(value)) return static_cast<Integer>(value);
  }
  // Throws, since a number is no text and a text no number.
  return json.is_number()
             ? static_cast<Integer>(json.template get_ref<const typename Json::string_t&>().size())
             : json.template get<Integer>();
}

/// A list of them.
template <std::integral Integer, class Json>
std::vector<Integer> integers_from(const Json& json) {
  std::vector<Integer> list;
  for (const Json& value : json.template get_ref<const typename Json::array_t&>())
    list.push_back(integer_from<Integer>(value));
  return list;
}

/// Three of them.
template <std::integral Integer, class Json>
std::array<Integer, 3> three_integers_from(const Json& json) {
  return {integer_from<Integer>(json.at(0)), integer_from<Integer>(json.at(1)),
          integer_from<Integer>(json.at(2))};
}

}  // namespace palpable
