// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <bitset>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace palpable::formats {

/// The values of 8 x 8 x 8 voxels of a level set, z fastest.
struct VdbBlock {
  static constexpr int kSide = 8;
  static constexpr std::size_t kVoxels = 512;

  /// Its least voxel.
  std::array<int, 3> corner{};
  /// Signed distances, metres; those that are not active are the half width with its sign.
  std::array<float, kVoxels> distance_m{};
  std::bitset<kVoxels> active;
};

/// A level set as it is handed to the writer of OpenVDB files.
struct VdbBlocks {
  /// The side of a voxel, and the place of voxel (0, 0, 0), metres.
  double voxel_m = 0.0;
  Vec3 origin_m;
  /// The distance of what no block covers, metres.
  float half_width_m = 0.0F;
  std::vector<std::unique_ptr<VdbBlock>> blocks;
};

/// The type and the name of the function in palpable-vdb-writer.so, which alone links OpenVDB: its library
/// has 69 000 symbols to be looked up at a start, so it is loaded only where a file is written. Takes the
/// blocks. Returns the file's bytes; throws std::exception for OpenVDB's own errors.
using WriteVdbBlocks = std::string(VdbBlocks& blocks);
inline constexpr const char* kWriteVdbBlocks = "palpable_write_vdb_blocks";

}  // namespace palpable::formats
