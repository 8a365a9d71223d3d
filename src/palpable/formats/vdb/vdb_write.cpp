// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/vdb/vdb.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>

#include <fmt/format.h>
// The only place where OpenVDB's headers, which take long to compile, are included.
#include <openvdb/Grid.h>
#include <openvdb/io/Archive.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/Tree.h>

namespace palpable::formats {
namespace {

using Tree = openvdb::tree::Tree4<float, 5, 4, 3>::Type;
using FloatGrid = openvdb::Grid<Tree>;
using Leaf = Tree::LeafNodeType;

/// Serialises to memory, since OpenVDB writes files only in place; ours are written atomically.
class MemoryArchive : public openvdb::io::Archive {
 public:
  std::string bytes(const FloatGrid::ConstPtr& grid) const {
    std::ostringstream stream(std::ios::binary);
    constexpr bool kSeekable = true;
    Archive::write(stream, openvdb::GridCPtrVec{grid}, kSeekable);
    return std::move(stream).str();
  }
};

/// Blocks of 8 x 8 x 8 voxels, counted from the field's least corner.
struct Blocks {
  std::array<int, 3> count{};
  double voxel_m = 0.0;
  Vec3 origin_m;

  int total() const { return count[0] * count[1] * count[2]; }
  openvdb::Coord corner(int i) const {
    return {8 * (i % count[0]), 8 * (i / count[0] % count[1]), 8 * (i / count[0] / count[1])};
  }
  Vec3 place(openvdb::Coord c) const {
    return origin_m + voxel_m * Vec3{1.0 * c.x(), 1.0 * c.y(), 1.0 * c.z()};
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
      const double distance_m =
          field.sample({blocks.place(blocks.corner(i)) + blocks.voxel_m * middle}).distance_m;
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
std::unique_ptr<Leaf> leaf_of(const Distance& field, const Blocks& blocks, int block, VdbBand band) {
  const auto width_m = static_cast<float>(kHalfWidth_voxels * blocks.voxel_m);
  auto leaf = std::make_unique<Leaf>(blocks.corner(block), width_m, false);
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
    const auto d = static_cast<float>(field.sample({blocks.place(leaf->offsetToGlobalCoord(i))}).distance_m);
    const bool active = d < width_m && (band == VdbBand::full || d > -width_m);
    if (active)
      leaf->setValueOn(i, d);
    else
      leaf->setValueOff(i, d < 0.0F ? -width_m : width_m);
  }
  if (leaf->isEmpty()) return nullptr;
  return leaf;
}

template <models::DistanceSurface Distance>
Result<FloatGrid::Ptr> grid_of(const Distance& field, const Blocks& blocks, VdbBand band, const Work& work) {
  work.report(0.0, "looking for the surface");
  const std::vector<int> wanted = blocks_in_band(field, blocks, band, work);
  constexpr std::size_t kMostBytes = std::size_t{2} << 30U;
  const std::size_t bytes = wanted.size() * sizeof(float) * Leaf::SIZE;
  if (bytes > kMostBytes)
    return Error{ErrorCode::failed,
                 fmt::format("would take {:.1f} GB of voxels; up to {:.1f} GB are written: take larger ones",
                             1e-9 * static_cast<double>(bytes), 1e-9 * static_cast<double>(kMostBytes)),
                 {}};
  std::vector<std::unique_ptr<Leaf>> leaves(wanted.size());
  work.report(0.1, "sampling the field");
  parallel_for(work, static_cast<int>(wanted.size()), 16, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i)
      leaves[static_cast<std::size_t>(i)] = leaf_of(field, blocks, wanted[static_cast<std::size_t>(i)], band);
  });
  if (work.cancelled()) return Work::interrupted();
  const auto grid = FloatGrid::create(static_cast<float>(kHalfWidth_voxels * blocks.voxel_m));
  for (auto& leaf : leaves)
    if (leaf) grid->tree().addLeaf(leaf.release());
  // Tiles with a negative sign represent the inside beyond the band.
  constexpr bool kThreaded = false;
  openvdb::tools::signedFloodFill(grid->tree(), kThreaded);
  const auto transform = openvdb::math::Transform::createLinearTransform(blocks.voxel_m);
  transform->postTranslate({blocks.origin_m.x, blocks.origin_m.y, blocks.origin_m.z});
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface");
  grid->setSaveFloatAsHalf(true);
  return grid;
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
    const auto grid = grid_of(field, blocks, options.band, work);
    if (!grid) return grid.error();
    MemoryArchive archive;
    archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    work.report(0.9, "packing the voxels");
    const std::string bytes = archive.bytes(*grid);
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
