// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/level_set.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/dense_field.hpp"
#include "palpable/models/field/distance_field.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace palpable::formats {

/// Which part of a field is written to an OpenVDB file.
enum class VdbBand : std::uint8_t {
  /// Three voxels on each side of the surface.
  narrow,
  /// The narrow band and the whole inside.
  full
};

struct VdbOptions {
  /// Side of the voxels, metres, > 0.
  double voxel_m = 0.0;
  VdbBand band = VdbBand::narrow;
};

/// A field as an OpenVDB level set named "surface", in metres, as half floats compressed by Blosc.
/// Long-running: uses all threads and polls for cancellation. Errors: usage for more than 4096 voxels along a
/// side; failed for more than 2 GiB of voxels (with the size needed) and for OpenVDB's own errors;
/// interrupted.
Result<std::vector<std::byte>> encode_vdb(const models::DistanceField& field, const VdbOptions& options,
                                          const Work& work);
Result<std::vector<std::byte>> encode_vdb(const models::DenseField& field, const VdbOptions& options,
                                          const Work& work);

/// Whether these are the first bytes of an OpenVDB file.
bool is_vdb(std::span<const std::byte> file);

/// The first level set of an OpenVDB file (else its first grid of unknown class) among its grids of floats or
/// half floats, uncompressed or compressed by zlib or Blosc. Read by our own code, since OpenVDB's reader
/// does not validate its input. Errors: invalid_input for files that are damaged, truncated, older than
/// format 222 (2013), without such a grid, of over a million blocks, with values that are not finite, or not
/// on a regular grid.
Result<LevelSet> decode_vdb(std::span<const std::byte> file);

/// The same from a file of at most 1 GiB; errors name it.
Result<LevelSet> read_vdb(const std::filesystem::path& path);

}  // namespace palpable::formats
