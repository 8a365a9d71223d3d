// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/map_codec.hpp"

#include <cstdint>
#include <cstdlib>

// Any bytes give a map that reads back as it was written, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::formats;
  const auto map = decode_street_map(std::as_bytes(std::span(data, size)));
  if (!map) {
    if (map.error().message.empty()) std::abort();
    return 0;
  }
  const Bytes written = encode_street_map(*map);
  const auto again = decode_street_map(written);
  if (!again || encode_street_map(*again) != written) std::abort();
  return 0;
}
