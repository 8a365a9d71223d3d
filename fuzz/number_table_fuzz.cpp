// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/number_table.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

// Any text gives rows of finite numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kWanted[] = {"t_s", "x_m", "y_m"};
  const auto table = palpable::parse_number_table({reinterpret_cast<const char*>(data), size}, kWanted);
  if (!table && table.error().message.empty()) std::abort();
  if (!table) return 0;
  if (table->columns != 3 || table->values.size() % 3 != 0 || table->rows() == 0) std::abort();
  for (const double value : table->values) {
    if (!std::isfinite(value)) std::abort();
    std::string text = "t_s,x_m,y_m\n0,0,";
    palpable::append_number(text, value);
    const auto again = palpable::parse_number_table(text, kWanted);
    if (!again || again->values[2] != value) std::abort();
  }
  return 0;
}
