// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/superquadric_json.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

// Any bytes give superquadrics of finite size, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto shapes = palpable::formats::decode_superquadrics(std::as_bytes(std::span(data, size)));
  if (!shapes) {
    if (shapes.error().message.empty()) std::abort();
    return 0;
  }
  for (const auto& shape : *shapes)
    if (!(std::isfinite(shape.size_m.x) && shape.size_m.x > 0.0)) std::abort();
  return 0;
}
