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

/// Size of a cache line on all supported processors. Variables of different threads are kept in different
/// lines, since sharing a line slows both threads down.
inline constexpr std::size_t kCacheLine_bytes = 64;

/// Passes the latest value from one writer thread to one reader thread (a triple buffer). Older values that
/// were not read are dropped by design; a value is never torn. Neither side waits, locks or allocates.
template <class T>
requires std::is_trivially_copyable_v<T>
class LatestValue {
 public:
  /// Writer's thread.
  void put(const T& value) noexcept {
    slots_[write_].value = value;
    write_ = middle_.exchange(write_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader's thread: stores the newest value and returns true if one was put since the last take(); else
  /// returns false and leaves `value` unchanged.
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

/// A bounded queue from one writer thread to one reader thread, for values that must not be lost. Memory is
/// allocated once, in the constructor. Neither side waits, locks or allocates. A full ring rejects new values
/// and counts them.
template <class T>
requires std::is_trivially_copyable_v<T>
class Ring {
 public:
  /// Holds at least `capacity` values (>= 1, rounded up to a power of two).
  explicit Ring(std::size_t capacity) : values_(power_of_two(capacity)), mask_(values_.size() - 1) {}

  /// Writer's thread: appends a value. False if the ring is full; the value is then counted in refused().
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

  /// Writer's thread: whether there is room for one more value.
  bool has_room() const noexcept {
    return end_.load(std::memory_order_relaxed) - begin_.load(std::memory_order_acquire) < values_.size();
  }

  /// Reader's thread: removes and returns the oldest value, if there is one.
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

  /// Number of values that were rejected because the ring was full. Any thread.
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
