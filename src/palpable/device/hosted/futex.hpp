// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <climits>
#include <cstdint>
#include <ctime>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

// Waiting for a number in memory that two processes share; std::atomic::wait() works within one only.
namespace palpable::device {

using FutexWord = std::atomic<std::uint32_t>;
static_assert(FutexWord::is_always_lock_free && sizeof(FutexWord) == sizeof(std::uint32_t));

/// Waits while `word` is `seen`, for at most `longest_ns`; may return earlier. Neither allocates nor throws.
inline void wait_while(FutexWord& word, std::uint32_t seen, std::int64_t longest_ns) noexcept {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  timespec longest{};
  longest.tv_sec = longest_ns / kSecond_ns;
  longest.tv_nsec = longest_ns % kSecond_ns;
  ::syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAIT, seen, &longest, nullptr, 0);
}

/// Changes `word` and wakes those that wait for it.
inline void advance(FutexWord& word) noexcept {
  word.fetch_add(1, std::memory_order_acq_rel);
  ::syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace palpable::device
