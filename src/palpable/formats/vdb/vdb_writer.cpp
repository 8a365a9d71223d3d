// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The module palpable-vdb-writer.so.
#include "palpable/formats/vdb/vdb_writer.hpp"

#include <cmath>
#include <memory>
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
static_assert(Leaf::DIM == LevelSet::kSide);

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

std::unique_ptr<Leaf> leaf_of(const LevelSet::Block& block, float background) {
  const auto& [x, y, z] = block.corner;
  auto leaf = std::make_unique<Leaf>(openvdb::Coord(x, y, z), background, false);
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
    const float value = block.values[i];
    if (std::abs(value) == background)
      leaf->setValueOff(i, value);
    else
      leaf->setValueOn(i, value);
  }
  return leaf;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void palpable_write_level_set(LevelSet& level_set,
                                                                                std::string& bytes) {
  const auto grid = FloatGrid::create(level_set.background);
  for (const LevelSet::Block& block : level_set.blocks)
    grid->tree().addLeaf(leaf_of(block, level_set.background).release());
  level_set.blocks = {};
  // Tiles with a negative sign represent the inside beyond the band.
  constexpr bool kThreaded = false;
  openvdb::tools::signedFloodFill(grid->tree(), kThreaded);
  const auto transform = openvdb::math::Transform::createLinearTransform(level_set.steps_m[0].x);
  transform->postTranslate({level_set.origin_m.x, level_set.origin_m.y, level_set.origin_m.z});
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface");
  grid->setSaveFloatAsHalf(true);
  MemoryArchive archive;
  archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  bytes = archive.bytes(grid);
}

}  // namespace palpable::formats
