// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/geometry/level_set.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::formats {

/// The encoding of a grid's values in an OpenVDB file.
struct VdbCoding {
  /// OpenVDB's flags: 1 zlib, 2 only active values, 4 Blosc.
  std::uint32_t compression = 0;
  /// Full or half floats.
  enum class Numbers : std::uint8_t { whole, half } numbers = Numbers::whole;
};

/// Reads a tree of floats with nodes of 32, 16 and 8 (OpenVDB's standard tree) from its buffer count on, into
/// blocks and background. Errors: invalid_input, as decode_vdb().
Result<LevelSet> read_vdb_tree(ByteReader& reader, const VdbCoding& coding);

}  // namespace palpable::formats
