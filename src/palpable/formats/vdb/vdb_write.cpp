// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/formats/vdb/vdb_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>

namespace palpable::formats {
namespace {

/// Blocks of voxels, counted from the field's least corner.
struct Blocks {
  std::array<int, 3> count{};
  double voxel_m = 0.0;
  Vec3 origin_m;

  int total() const { return count[0] * count[1] * count[2]; }
  std::array<int, 3> corner(int i) const {
    return {8 * (i % count[0]), 8 * (i / count[0] % count[1]), 8 * (i / count[0] / count[1])};
  }
  /// Of a voxel from the corner of a block.
  Vec3 place(const std::array<int, 3>& corner, Vec3 voxel) const {
    return origin_m + voxel_m * (Vec3{1.0 * corner[0], 1.0 * corner[1], 1.0 * corner[2]} + voxel);
  }
};

constexpr double kHalfWidth_voxels = 3.0;

/// The blocks that intersect the band.
template <models::DistanceSurface Distance>
std::vector<int> blocks_in_band(const Distance& field, const Blocks& blocks, VdbBand band, const Work& work) {
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(blocks.total()));
  parallel_for(work, blocks.total(), 64, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i) {
      const Vec3 middle{3.5, 3.5, 3.5};
      const double distance_m = field.sample({blocks.place(blocks.corner(i), middle)}).distance_m;
      // Half of a block's diagonal, and a margin for the field's error.
      const double reach_m = (norm(middle) + kHalfWidth_voxels + 1.0) * blocks.voxel_m;
      const bool near = band == VdbBand::full ? distance_m < reach_m : std::abs(distance_m) < reach_m;
      wanted[static_cast<std::size_t>(i)] = near ? 1 : 0;
    }
  });
  std::vector<int> list;
  for (int i = 0; i < blocks.total(); ++i)
    if (wanted[static_cast<std::size_t>(i)] != 0) list.push_back(i);
  return list;
}

/// A block's values; null if none of them is in the band.
template <models::DistanceSurface Distance>
std::unique_ptr<VdbBlock> block_of(const Distance& field, const Blocks& blocks, int number, VdbBand band) {
  const auto width_m = static_cast<float>(kHalfWidth_voxels * blocks.voxel_m);
  auto block = std::make_unique<VdbBlock>();
  block->corner = blocks.corner(number);
  for (std::size_t i = 0; i < VdbBlock::kVoxels; ++i) {
    const Vec3 voxel{static_cast<double>(i / 64), static_cast<double>(i / 8 % 8), static_cast<double>(i % 8)};
    const auto d = static_cast<float>(field.sample({blocks.place(block->corner, voxel)}).distance_m);
    block->active[i] = d < width_m && (band == VdbBand::full || d > -width_m);
    block->distance_m[i] = block->active[i] ? d : (d < 0.0F ? -width_m : width_m);
  }
  if (block->active.none()) return nullptr;
  return block;
}

template <models::DistanceSurface Distance>
Result<VdbBlocks> level_set_of(const Distance& field, const Blocks& blocks, VdbBand band, const Work& work) {
  work.report(0.0, "looking for the surface");
  const std::vector<int> wanted = blocks_in_band(field, blocks, band, work);
  constexpr std::size_t kMostBytes = std::size_t{2} << 30U;
  const std::size_t bytes = wanted.size() * sizeof(float) * VdbBlock::kVoxels;
  if (bytes > kMostBytes)
    return Error{ErrorCode::failed,
                 fmt::format("would take {:.1f} GB of voxels; up to {:.1f} GB are written: take larger ones",
                             1e-9 * static_cast<double>(bytes), 1e-9 * static_cast<double>(kMostBytes)),
                 {}};
  VdbBlocks level_set{
      blocks.voxel_m, blocks.origin_m, static_cast<float>(kHalfWidth_voxels * blocks.voxel_m), {}};
  level_set.blocks.resize(wanted.size());
  work.report(0.1, "sampling the field");
  parallel_for(work, static_cast<int>(wanted.size()), 16, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i)
      level_set.blocks[static_cast<std::size_t>(i)] =
          block_of(field, blocks, wanted[static_cast<std::size_t>(i)], band);
  });
  if (work.cancelled()) return Work::interrupted();
  std::erase(level_set.blocks, nullptr);
  return level_set;
}

/// The function in the module, which stays loaded. Errors: failed.
Result<WriteVdbBlocks*> writer() {
  const auto module =
      helper_program("palpable-vdb-writer.so", "PALPABLE_VDB_WRITER", PALPABLE_VDB_WRITER_FOLDER);
  if (!module)
    return Error{ErrorCode::failed, "OpenVDB files cannot be written: " + module.error().message, {}};
  void* const loaded = ::dlopen(module->c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const found = loaded == nullptr ? nullptr : ::dlsym(loaded, kWriteVdbBlocks);
  if (found == nullptr)
    return Error{ErrorCode::failed, std::string("OpenVDB files cannot be written: ") + ::dlerror(), {}};
  return reinterpret_cast<WriteVdbBlocks*>(found);
}

template <models::DistanceSurface Distance>
Result<std::vector<std::byte>> encode(const Distance& field, const VdbOptions& options, const Work& work) {
  const Vec3 size = field.size_m();
  constexpr double kMostVoxels = 4096;
  if (!(options.voxel_m > 0.0) || std::max({size.x, size.y, size.z}) / options.voxel_m > kMostVoxels)
    return Error{ErrorCode::usage, "a level set has 1 to 4096 voxels along each side", {}};
  const auto count = [&](double extent_m) {
    return static_cast<int>(std::ceil((extent_m / options.voxel_m + 1.0) / 8.0));
  };
  const Blocks blocks{{count(size.x), count(size.y), count(size.z)}, options.voxel_m, field.origin_m()};
  try {
    const auto write = writer();
    if (!write) return write.error();
    auto level_set = level_set_of(field, blocks, options.band, work);
    if (!level_set) return level_set.error();
    work.report(0.9, "packing the voxels");
    const std::string bytes = (*write)(*level_set);
    const auto view = as_bytes(bytes);
    return std::vector<std::byte>(view.begin(), view.end());
  } catch (const std::exception& e) {
    return Error{ErrorCode::failed, std::string("OpenVDB cannot write it: ") + e.what(), {}};
  }
}

}  // namespace

Result<std::vector<std::byte>> encode_vdb(const models::DistanceField& field, const VdbOptions& options,
                                          const Work& work) {
  return encode(field, options, work);
}

Result<std::vector<std::byte>> encode_vdb(const models::DenseField& field, const VdbOptions& options,
                                          const Work& work) {
  return encode(field, options, work);
}

}  // namespace palpable::formats
