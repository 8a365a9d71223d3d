// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/vdb/vdb_tree.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <blosc.h>
#include <zlib.h>

namespace palpable::formats {
namespace {

using Numbers = VdbCoding::Numbers;
using Corner = std::array<int, 3>;

constexpr std::size_t kMostBlocks = 1'000'000;
constexpr std::uint32_t kZip = 1, kActiveMask = 2, kBlosc = 4;

float from_half(std::uint16_t bits) {
  const unsigned exponent = bits >> 10U & 31U, mantissa = bits & 1023U;
  const float sign = (bits & 0x8000U) != 0 ? -1.0F : 1.0F;
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(mantissa), -24);
  if (exponent == 31) return std::numeric_limits<float>::quiet_NaN();
  return sign * std::ldexp(static_cast<float>(mantissa + 1024U), static_cast<int>(exponent) - 25);
}

/// A node's mask, one bit for each of its children or values.
class Mask {
 public:
  Mask(ByteReader& reader, std::size_t bits) : bytes_(reader.bytes(bits / 8)) {}
  bool on(std::size_t i) const {
    return !bytes_.empty() && (std::to_integer<unsigned>(bytes_[i / 8]) >> (i % 8) & 1U) != 0;
  }
  std::size_t count() const {
    std::size_t sum = 0;
    for (const std::byte b : bytes_)
      sum += static_cast<std::size_t>(std::popcount(std::to_integer<unsigned>(b)));
    return sum;
  }

 private:
  std::span<const std::byte> bytes_;
};

/// Decompresses bytes; nullopt unless the result has exactly `size` bytes.
std::optional<std::vector<std::byte>> unpacked(std::span<const std::byte> packed, std::size_t size,
                                               std::uint32_t compression) {
  std::vector<std::byte> bytes(size);
  if ((compression & kBlosc) != 0) {
    std::size_t holds = 0;
    if (blosc_cbuffer_validate(packed.data(), packed.size(), &holds) != 0 || holds != size)
      return std::nullopt;
    constexpr int kThreads = 1;
    const int got = blosc_decompress_ctx(packed.data(), bytes.data(), size, kThreads);
    if (got < 0 || static_cast<std::size_t>(got) != size) return std::nullopt;
    return bytes;
  }
  uLongf got = size;
  const int state = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                               reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (state != Z_OK || got != size) return std::nullopt;
  return bytes;
}

/// Reads a tree. After the first error ok() stays false and nothing more is read.
class TreeReader {
 public:
  TreeReader(ByteReader& reader, const VdbCoding& coding) : reader_(reader), coding_(coding) {}

  LevelSet read() {
    reader_.u32();  // Number of buffers per leaf: always 1 in these formats.
    set_.background = reader_.f32();
    const std::uint32_t tiles = reader_.u32(), children = reader_.u32();
    // The surface does not cross a tile, so the blocks suffice.
    constexpr std::size_t kTileBytes = 3 * 4 + 4 + 1, kNodeBytes = 3 * 4 + 2 * 4096;
    if (tiles > reader_.left() / kTileBytes || children > reader_.left() / kNodeBytes) return fail();
    reader_.skip(tiles * kTileBytes);
    for (std::uint32_t i = 0; i < children && ok(); ++i) {
      const Corner corner = read_corner();
      if (ok()) topology(corner, 5);
    }
    for (std::size_t i = 0; i < set_.blocks.size() && ok(); ++i) values(set_.blocks[i]);
    return std::move(set_);
  }

  bool ok() const { return sound_ && reader_.ok(); }

 private:
  LevelSet fail() {
    sound_ = false;
    return {};
  }

  Corner read_corner() {
    Corner corner{};
    for (int& c : corner) {
      c = static_cast<std::int32_t>(reader_.u32());
      // Far beyond any real grid; block coordinates stay in the range of int below that.
      constexpr int kFarthest = 1 << 28;
      if (c % 4096 != 0 || c < -kFarthest || c > kFarthest) sound_ = false;
    }
    return corner;
  }

  /// Reads the children of a node with 2^log2_side of them along each side; below nodes of 16 they are
  /// blocks.
  void topology(Corner corner, unsigned log2_side) {
    const std::size_t count = std::size_t{1} << (3 * log2_side);
    const Mask children(reader_, count), active(reader_, count);
    skip_numbers(count, active);
    const int child_side = log2_side == 5 ? 16 * LevelSet::kSide : LevelSet::kSide;
    for (std::size_t i = 0; i < count && ok(); ++i) {
      if (!children.on(i)) continue;
      const auto place = [&](unsigned axis) {
        const std::size_t bits = i >> ((2 - axis) * log2_side) & ((std::size_t{1} << log2_side) - 1);
        return corner[axis] + static_cast<int>(bits) * child_side;
      };
      const Corner child{place(0), place(1), place(2)};
      if (log2_side == 5) {
        topology(child, 4);
        continue;
      }
      reader_.skip(512 / 8);  // The mask of active values, which is repeated with the values.
      if (set_.blocks.size() == kMostBlocks) {
        sound_ = false;
        return;
      }
      set_.blocks.push_back({child, {}});
    }
  }

  void values(LevelSet::Block& block) {
    const Mask active(reader_, block.values.size());
    const Kept n = numbers(block.values.size(), active);
    if (!ok()) return;
    std::size_t next = 0;
    for (std::size_t i = 0; i < block.values.size(); ++i) {
      const bool kept = n.all || active.on(i);
      block.values[i] = kept ? n.values[next++] : (n.selection && n.selection->on(i) ? n.other : n.inactive);
      if (!std::isfinite(block.values[i])) sound_ = false;
    }
  }

  /// A node's stored values: all, or those at active places and at most two for the others.
  struct Kept {
    bool all = true;
    float inactive = 0.0F, other = 0.0F;
    std::optional<Mask> selection;
    std::vector<float> values;
  };

  /// Reads the header before the values, and their number.
  Kept read_head(std::size_t count, const Mask& active, std::size_t& kept) {
    Kept n;
    const unsigned kind = reader_.u8();
    constexpr unsigned kAll = 6;
    if (kind > kAll) sound_ = false;
    n.other = set_.background;
    n.inactive = kind == 0 ? set_.background : -set_.background;
    // Always full floats.
    if (kind == 2 || kind == 4 || kind == 5) n.inactive = reader_.f32();
    if (kind == 5) n.other = reader_.f32();
    if (kind >= 3 && kind <= 5) n.selection = Mask(reader_, count);
    n.all = (coding_.compression & kActiveMask) == 0 || kind == kAll;
    kept = n.all ? count : active.count();
    return n;
  }

  Kept numbers(std::size_t count, const Mask& active) {
    std::size_t kept = 0;
    Kept n = read_head(count, active, kept);
    const std::size_t each = coding_.numbers == Numbers::half ? 2 : 4;
    if (nothing_follows(kept)) return n;
    const auto bytes = read_packed(kept * each);
    if (!ok()) return n;
    ByteReader source(bytes);
    n.values.resize(kept);
    for (float& v : n.values) v = coding_.numbers == Numbers::half ? from_half(source.u16()) : source.f32();
    return n;
  }

  bool nothing_follows(std::size_t kept) const { return kept == 0 && coding_.numbers == Numbers::half; }

  /// Skips the values of a node's tiles, which are not needed.
  void skip_numbers(std::size_t count, const Mask& active) {
    std::size_t kept = 0;
    read_head(count, active, kept);
    if (nothing_follows(kept)) return;
    const std::size_t each = coding_.numbers == Numbers::half ? 2 : 4;
    if ((coding_.compression & (kZip | kBlosc)) == 0) {
      reader_.skip(kept * each);
      return;
    }
    reader_.skip(packed_size(kept * each));
  }

  /// The number of bytes that follow; a stored size that is negative or 0 means uncompressed.
  std::size_t packed_size(std::size_t size) {
    const auto stated = static_cast<std::int64_t>(reader_.u64());
    packed_ = stated > 0;
    const std::uint64_t bytes = packed_ ? static_cast<std::uint64_t>(stated) : size;
    if ((!packed_ && stated != -static_cast<std::int64_t>(size)) || bytes > reader_.left()) sound_ = false;
    return sound_ ? static_cast<std::size_t>(bytes) : 0;
  }

  std::vector<std::byte> read_packed(std::size_t size) {
    if (!ok()) return {};
    if ((coding_.compression & (kZip | kBlosc)) == 0) {
      const auto raw = reader_.bytes(size);
      return {raw.begin(), raw.end()};
    }
    const auto raw = reader_.bytes(packed_size(size));
    if (!ok() || size == 0) return {};
    if (!packed_) return {raw.begin(), raw.end()};
    auto bytes = unpacked(raw, size, coding_.compression);
    if (!bytes) {
      sound_ = false;
      return {};
    }
    return *std::move(bytes);
  }

  ByteReader& reader_;
  VdbCoding coding_;
  LevelSet set_;
  bool sound_ = true;
  bool packed_ = false;
};

}  // namespace

Result<LevelSet> read_vdb_tree(ByteReader& reader, const VdbCoding& coding) {
  TreeReader tree(reader, coding);
  LevelSet set = tree.read();
  if (!tree.ok())
    return invalid_input("is a damaged or cut-off OpenVDB file, or holds over a million blocks of voxels");
  return set;
}

}  // namespace palpable::formats
