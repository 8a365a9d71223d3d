// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/formats/vdb/vdb_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include <dlfcn.h>
#include <elf.h>
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

/// A block's values; false if none of them is in the band. What is not has the background's magnitude.
template <models::DistanceSurface Distance>
bool fill(LevelSet::Block& block, const Distance& field, const Blocks& blocks, float width_m, VdbBand band) {
  bool is_in_band = false;
  for (std::size_t i = 0; i < block.values.size(); ++i) {
    const Vec3 voxel{static_cast<double>(i / 64), static_cast<double>(i / 8 % 8), static_cast<double>(i % 8)};
    const auto d = static_cast<float>(field.sample({blocks.place(block.corner, voxel)}).distance_m);
    const bool in_band = d < width_m && (band == VdbBand::full || d > -width_m);
    block.values[i] = in_band ? d : (d < 0.0F ? -width_m : width_m);
    is_in_band = is_in_band || in_band;
  }
  return is_in_band;
}

template <models::DistanceSurface Distance>
Result<LevelSet> level_set_of(const Distance& field, const Blocks& blocks, VdbBand band, const Work& work) {
  work.report(0.0, "looking for the surface");
  const std::vector<int> wanted = blocks_in_band(field, blocks, band, work);
  constexpr std::size_t kMostBytes = std::size_t{2} << 30U;
  const std::size_t bytes = wanted.size() * sizeof(LevelSet::Block::values);
  if (bytes > kMostBytes)
    return Error{ErrorCode::failed,
                 fmt::format("would take {:.1f} GB of voxels; up to {:.1f} GB are written: take larger ones",
                             1e-9 * static_cast<double>(bytes), 1e-9 * static_cast<double>(kMostBytes)),
                 {}};
  const double step = blocks.voxel_m;
  LevelSet level_set{std::vector<LevelSet::Block>(wanted.size()),
                     static_cast<float>(kHalfWidth_voxels * step),
                     blocks.origin_m,
                     {Vec3{step, 0.0, 0.0}, Vec3{0.0, step, 0.0}, Vec3{0.0, 0.0, step}}};
  std::vector<std::uint8_t> is_kept(wanted.size());
  work.report(0.1, "sampling the field");
  parallel_for(work, static_cast<int>(wanted.size()), 16, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end) && !work.cancelled();
         ++i) {
      LevelSet::Block& block = level_set.blocks[i];
      block.corner = blocks.corner(wanted[i]);
      is_kept[i] = fill(block, field, blocks, level_set.background, band) ? 1 : 0;
    }
  });
  if (work.cancelled()) return Work::interrupted();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (is_kept[i] != 0) level_set.blocks[kept++] = level_set.blocks[i];
  level_set.blocks.resize(kept);
  return level_set;
}

/// Whether a module is whole: its table of sections, which is at its end, lies within it. The loader does not
/// look, and a module that was cut off ends the program by a signal.
bool is_whole(const std::filesystem::path& module) {
  Elf64_Ehdr header{};
  std::error_code error;
  const auto bytes = std::filesystem::file_size(module, error);
  std::ifstream file(module, std::ios::binary);
  if (error || !file.read(reinterpret_cast<char*>(&header), sizeof header)) return false;
  const std::uint64_t sections = std::uint64_t{header.e_shentsize} * header.e_shnum;
  return std::string_view(reinterpret_cast<const char*>(header.e_ident), SELFMAG) == ELFMAG &&
         header.e_shoff <= bytes && sections <= bytes - header.e_shoff;
}

struct Writer {
  WriteLevelSet* write = nullptr;
};

/// The function in the module, which stays loaded. Errors: failed.
Result<Writer> writer() {
  const auto module =
      helper_module("palpable-vdb-writer.so", "PALPABLE_VDB_WRITER", PALPABLE_VDB_WRITER_FOLDER);
  if (!module)
    return Error{ErrorCode::failed, "OpenVDB files cannot be written: " + module.error().message, {}};
  if (!is_whole(*module))
    return Error{ErrorCode::failed,
                 "OpenVDB files cannot be written: " + module->string() + " is no module, or is cut off",
                 {}};
  void* const loaded = ::dlopen(module->c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const found = loaded == nullptr ? nullptr : ::dlsym(loaded, kWriteLevelSet);
  if (found == nullptr)
    return Error{ErrorCode::failed, std::string("OpenVDB files cannot be written: ") + ::dlerror(), {}};
  return Writer{reinterpret_cast<WriteLevelSet*>(found)};
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
    const auto module = writer();
    if (!module) return module.error();
    auto level_set = level_set_of(field, blocks, options.band, work);
    if (!level_set) return level_set.error();
    work.report(0.9, "packing the voxels");
    std::string bytes;
    module->write(*level_set, bytes);
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
