// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/real_time.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace palpable::haptics {

std::string lock_memory() {
  // With a finite limit, locking future pages would make later allocations fail, which is worse than a page
  // fault.
  rlimit limit{};
  if (geteuid() != 0 && (getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY))
    return "not locked (the limit \"memlock\" is finite)";
  // MCL_ONFAULT: otherwise every thread's whole stack and all reserved memory would be filled at once.
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0)
    return std::string("not locked (") + std::strerror(errno) + ")";
  return "locked";
}

void flush_denormals() noexcept {
#if defined(__x86_64__)
  constexpr unsigned kFlushToZero = 1U << 15;
  constexpr unsigned kDenormalsAreZero = 1U << 6;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
#elif defined(__aarch64__)
  std::uint64_t control = 0;
  asm volatile("mrs %0, fpcr" : "=r"(control));
  asm volatile("msr fpcr, %0" : : "r"(control | (std::uint64_t{1} << 24)));
#endif
}

void touch_stack() noexcept {
  constexpr std::size_t kStack_bytes = 65536;
  volatile std::byte stack[kStack_bytes];
  for (std::size_t i = 0; i < kStack_bytes; i += 1024) stack[i] = std::byte{0};
  static_cast<void>(stack[0]);
}

}  // namespace palpable::haptics
