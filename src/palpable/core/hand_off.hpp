// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/check.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace palpable {

/// Two threads that share a cache line slow each other down; 64 bytes on every processor that we build for.
inline constexpr std::size_t kCacheLine_bytes = 64;

/// The latest value from one writing thread to one reading thread (a triple buffer). Values in between are
/// lost by design; a value is never torn. Neither side waits, locks or allocates.
template <class T>
requires std::is_trivially_copyable_v<T>
class LatestValue {
 public:
  /// Writer's thread.
  void put(const T& value) noexcept {
    slots_[write_].value = value;
    write_ = middle_.exchange(write_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader's thread: true and the newest value if one came since the last take(); false and `value`
  /// untouched otherwise.
  bool take(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    read_ = middle_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    value = slots_[read_].value;
    return true;
  }

 private:
  static constexpr unsigned kFresh = 4;
  static constexpr unsigned kIndex = 3;
  struct alignas(kCacheLine_bytes) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(kCacheLine_bytes) unsigned write_ = 0;
  alignas(kCacheLine_bytes) std::atomic<unsigned> middle_{1};
  alignas(kCacheLine_bytes) unsigned read_ = 2;
};

/// A bounded queue from one writing thread to one reading thread, for what must not be lost. Memory is taken
/// once, at construction. Neither side waits, locks or allocates; a full ring refuses and counts.
template <class T>
requires std::is_trivially_copyable_v<T>
class Ring {
 public:
  /// Holds at least `capacity` values (rounded up to a power of two), 1 or more.
  explicit Ring(std::size_t capacity) : values_(power_of_two(capacity)), mask_(values_.size() - 1) {}

  /// Writer's thread: false, and counted in refused(), if the ring is full.
  bool put(const T& value) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_seen_ == values_.size()) {
      begin_seen_ = begin_.load(std::memory_order_acquire);
      if (end - begin_seen_ == values_.size()) {
        refused_.store(refused_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    values_[end & mask_] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// Writer's thread: room for one more value?
  bool has_room() const noexcept {
    return end_.load(std::memory_order_relaxed) - begin_.load(std::memory_order_acquire) < values_.size();
  }

  /// Reader's thread: the oldest value, if there is one.
  std::optional<T> take() noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_seen_) {
      end_seen_ = end_.load(std::memory_order_acquire);
      if (begin == end_seen_) return std::nullopt;
    }
    const T value = values_[begin & mask_];
    begin_.store(begin + 1, std::memory_order_release);
    return value;
  }

  /// Values lost because the ring was full. Any thread.
  std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
  std::size_t capacity() const noexcept { return values_.size(); }

 private:
  static std::size_t power_of_two(std::size_t wanted) {
    PALPABLE_CHECK(wanted >= 1 && wanted <= (std::size_t{1} << 30));
    std::size_t size = 1;
    while (size < wanted) size *= 2;
    return size;
  }

  std::vector<T> values_;
  std::size_t mask_;
  alignas(kCacheLine_bytes) std::atomic<std::size_t> end_{0};
  std::size_t begin_seen_ = 0;
  std::atomic<std::uint64_t> refused_{0};
  alignas(kCacheLine_bytes) std::atomic<std::size_t> begin_{0};
  std::size_t end_seen_ = 0;
};

}  // namespace palpable
