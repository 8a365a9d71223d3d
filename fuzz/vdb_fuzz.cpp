// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/vdb/vdb.hpp"

#include <cmath>
#include <cstdlib>

// Any bytes give blocks of finite numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable;
  const auto set = formats::decode_vdb(std::as_bytes(std::span(data, size)));
  if (!set) return 0;
  for (const LevelSet::Block& block : set->blocks)
    for (const float v : block.values)
      if (!std::isfinite(v)) std::abort();
  return 0;
}
