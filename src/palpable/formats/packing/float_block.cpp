// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/float_block.hpp"

#include "palpable/formats/packing/float_planes.hpp"
#include "palpable/formats/packing/zstd_frame.hpp"

#include <zstd.h>

namespace palpable::formats {

Result<std::vector<std::byte>> pack_floats(std::span<const float> values, std::size_t row,
                                           std::size_t stride) {
  constexpr int kLevel = 9;
  PlanesOf planes(values, row, stride);
  return zstd_frame(
      planes.bytes(), [&](std::span<std::byte> piece) { planes.next(piece); }, kLevel);
}

Result<std::vector<float>> unpack_floats(std::span<const std::byte> packed, std::size_t count,
                                         std::size_t row) {
  const Error damaged = invalid_input("holds numbers that are damaged or cut off");
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != 4 * count) return damaged;
  if (!may_unpack(packed.size(), 4 * count)) return damaged;
  std::vector<std::byte> planes(4 * count);
  const std::size_t size = ZSTD_decompress(planes.data(), planes.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0U || size != planes.size()) return damaged;
  return floats_of(planes, row);
}

}  // namespace palpable::formats
