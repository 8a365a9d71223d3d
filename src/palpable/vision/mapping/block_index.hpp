// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace palpable::vision {

/// The place of a block of voxels in a sparse map, in blocks from the origin. Each component lies in
/// -2^20 … 2^20 - 1.
struct BlockPlace {
  int x = 0, y = 0, z = 0;
  bool operator==(const BlockPlace&) const = default;
};

/// Finds blocks by their place: a hash table with open addressing and linear probing. Entries are never
/// removed; the map makes a new index when blocks go.
class BlockIndex {
 public:
  static constexpr std::int32_t kNone = -1;

  BlockIndex() : slots_(kFirstSlots) {}

  /// The number that insert() was given for this place; kNone if there is none.
  std::int32_t find(BlockPlace place) const {
    const std::uint64_t key = key_of(place);
    for (std::size_t at = slot_of(key);; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at].number == kNone) return kNone;
      if (slots_[at].key == key) return slots_[at].number;
    }
  }

  /// `place` must not be there; `number` >= 0.
  void insert(BlockPlace place, std::int32_t number) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    put({key_of(place), number});
    ++count_;
  }

  std::size_t bytes() const { return slots_.size() * sizeof(Slot); }

 private:
  static constexpr std::size_t kFirstSlots = 1024;
  struct Slot {
    std::uint64_t key = 0;
    std::int32_t number = kNone;
  };

  static std::uint64_t key_of(BlockPlace p) {
    constexpr int kHalf = 1 << 20;
    const auto part = [](int v) { return static_cast<std::uint64_t>(v + kHalf) & 0x1FFFFFU; };
    return part(p.x) << 42U | part(p.y) << 21U | part(p.z);
  }
  std::size_t slot_of(std::uint64_t key) const {
    // Multiplicative hashing (Knuth, The Art of Computer Programming 3, 6.4).
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> 32U) & (slots_.size() - 1);
  }
  void put(const Slot& slot) {
    std::size_t at = slot_of(slot.key);
    while (slots_[at].number != kNone) at = (at + 1) & (slots_.size() - 1);
    slots_[at] = slot;
  }
  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old)
      if (slot.number != kNone) put(slot);
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace palpable::vision
