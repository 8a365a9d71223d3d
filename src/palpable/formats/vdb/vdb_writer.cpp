// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The module palpable-vdb-writer.so.
#include "palpable/formats/vdb/vdb_blocks.hpp"

#include <sstream>
#include <utility>

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
static_assert(Leaf::DIM == VdbBlock::kSide && Leaf::SIZE == VdbBlock::kVoxels);

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

std::unique_ptr<Leaf> leaf_of(const VdbBlock& block, float half_width_m) {
  const auto& [x, y, z] = block.corner;
  auto leaf = std::make_unique<Leaf>(openvdb::Coord(x, y, z), half_width_m, false);
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
    if (block.active[i])
      leaf->setValueOn(i, block.distance_m[i]);
    else
      leaf->setValueOff(i, block.distance_m[i]);
  }
  return leaf;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) std::string palpable_write_vdb_blocks(
    VdbBlocks& level_set) {
  const auto grid = FloatGrid::create(level_set.half_width_m);
  for (auto& block : level_set.blocks) {
    grid->tree().addLeaf(leaf_of(*block, level_set.half_width_m).release());
    block.reset();
  }
  // Tiles with a negative sign represent the inside beyond the band.
  constexpr bool kThreaded = false;
  openvdb::tools::signedFloodFill(grid->tree(), kThreaded);
  const auto transform = openvdb::math::Transform::createLinearTransform(level_set.voxel_m);
  transform->postTranslate({level_set.origin_m.x, level_set.origin_m.y, level_set.origin_m.z});
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface");
  grid->setSaveFloatAsHalf(true);
  MemoryArchive archive;
  archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  return archive.bytes(grid);
}

}  // namespace palpable::formats
