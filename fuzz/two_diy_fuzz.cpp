// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/two_diy_wire.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

// Any bytes from a board give finite angles or none, however the line divides them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  palpable::device::TwoDiyAnswers whole;
  palpable::device::TwoDiyAnswers divided;
  const auto last = whole.take(bytes);
  std::optional<std::array<float, 2>> last_divided;
  for (const std::byte& byte : bytes)
    if (const auto angles = divided.take(std::span(&byte, 1))) last_divided = angles;
  if (last != last_divided || whole.complete() != divided.complete() || whole.dropped() != divided.dropped())
    std::abort();
  if (last && !(std::isfinite((*last)[0]) && std::isfinite((*last)[1]))) std::abort();
  return 0;
}
