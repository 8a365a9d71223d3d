// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/byte_reader.hpp"
#include "palpable/core/level_set.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::formats {

/// How a grid's numbers lie in an OpenVDB file.
struct VdbCoding {
  /// OpenVDB's flags: 1 zlib, 2 only active values, 4 Blosc.
  std::uint32_t compression = 0;
  /// Floats are kept as halves.
  enum class Numbers : std::uint8_t { whole, half } numbers = Numbers::whole;
};

/// Reads a tree of floats with nodes of 32, 16 and 8 (OpenVDB's usual one), from its count of buffers on,
/// into blocks and background. Errors: invalid_input, as decode_vdb().
Result<LevelSet> read_vdb_tree(ByteReader& reader, const VdbCoding& coding);

}  // namespace palpable::formats
