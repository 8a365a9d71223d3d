// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/field_streams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

// The first byte selects a grid; the others are a field's streams (decompressed), each after its length in
// two bytes. A field that can be read has a finite distance everywhere and survives a round trip.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable;
  if (size == 0) return 0;
  constexpr std::array<models::FieldGrid, 2> kGrids{
      models::FieldGrid{{-0.01, 0.0, 0.002}, 0.001, 3, {2, 1, 1}},
      models::FieldGrid{{0.0, 0.0, 0.0}, 0.00125, 0, {20, 20, 20}}};
  const models::FieldGrid& grid = kGrids[data[0] % kGrids.size()];
  formats::FieldStreams streams;
  std::size_t at = 1;
  for (auto& stream : streams.bytes) {
    if (size - at < 2) break;
    const std::size_t length = std::min(data[at] | (std::size_t{data[at + 1]} << 8U), size - at - 2);
    stream.assign(data + at + 2, data + at + 2 + length);
    at += 2 + length;
  }
  auto tree = formats::tree_from(grid, streams);
  if (!tree) return 0;
  const auto field = models::DistanceField::from_tree(grid, *std::move(tree), {});
  if (!field) return 0;
  for (int i = 0; i < 64; ++i) {
    const Vec3 p =
        grid.origin_m + 0.0007 * Vec3{1.0 * (i % 4) * 5.0, 1.0 * (i / 4 % 4) * 3.0, 1.0 * (i / 16) * 3.0};
    const models::FieldSample s = field->sample({p});
    if (!std::isfinite(s.distance_m)) std::abort();
  }
  const auto again = formats::tree_from(grid, formats::streams_of(grid, field->tree()));
  if (!again || again->nodes != field->tree().nodes || again->words != field->tree().words) std::abort();
  return 0;
}
