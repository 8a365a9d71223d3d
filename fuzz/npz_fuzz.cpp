// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/npz.hpp"

#include <cstdlib>

// Any bytes give an array whose size fits its shape, or an error. An array that can be read survives a round
// trip.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::formats;
  const auto file = std::as_bytes(std::span(data, size));
  static_cast<void>(decode_npz(file));
  const auto array = decode_npy(file);
  if (!array) return 0;
  std::size_t count = 1;
  for (const std::size_t side : array->shape) count *= side;
  if (array->bytes.size() != count * size_of(array->type)) std::abort();
  const auto again = decode_npy(encode_npy(*array));
  if (!again || again->bytes != array->bytes || again->shape != array->shape) std::abort();
  return 0;
}
