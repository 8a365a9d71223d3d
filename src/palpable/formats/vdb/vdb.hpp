// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/level_set.hpp"
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

/// How much of a field an OpenVDB file holds.
enum class VdbBand : std::uint8_t {
  /// Three voxels to each side of the surface.
  narrow,
  /// And the whole inside.
  full
};

struct VdbOptions {
  /// Side of the voxels, metres, > 0.
  double voxel_m = 0.0;
  VdbBand band = VdbBand::narrow;
};

/// A field as an OpenVDB level set named "surface", in metres, half floats, packed by Blosc. Long work: all
/// threads, polls cancel. Errors: usage for a voxel that makes over 4096 along a side; failed for over 2 GiB
/// of voxels, naming what they would take, and what OpenVDB reports; interrupted.
Result<std::vector<std::byte>> encode_vdb(const models::DistanceField& field, const VdbOptions& options,
                                          const Work& work);
Result<std::vector<std::byte>> encode_vdb(const models::DenseField& field, const VdbOptions& options,
                                          const Work& work);

/// Whether these are the first bytes of an OpenVDB file.
bool is_vdb(std::span<const std::byte> file);

/// The first level set of an OpenVDB file (else its first grid of unknown class) among its grids of floats,
/// whole or half, unpacked or packed by zlib or Blosc. Read by our own code, since OpenVDB's trusts its
/// files. Errors: invalid_input for what is damaged, cut off, older than format 222 (2013), without such a
/// grid, of over a million blocks, with numbers that are not finite, or not on a regular grid.
Result<LevelSet> decode_vdb(std::span<const std::byte> file);

/// The same from a file of at most 1 GiB; errors name it.
Result<LevelSet> read_vdb(const std::filesystem::path& path);

}  // namespace palpable::formats
