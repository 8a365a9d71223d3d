// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Linked as an object into programs that count allocations. glibc lets a program define malloc and related
// functions; the originals remain available as __libc_*. operator new needs no replacement, since it calls
// malloc. Sanitizers have their own malloc, so their hook is used there.
#include "palpable/core/system/allocations.hpp"

#include <cerrno>
#include <cstddef>

namespace {
// Runs during static initialisation, before any thread of this program.
const bool kDeclared = (palpable::allocation_counter::declare_linked(), true);
}  // namespace

#ifdef PALPABLE_SANITIZED

// Every sanitizer's run-time library defines it, but g++'s package lacks the header that declares it.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {
const int hooked = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { palpable::allocation_counter::note(); },
    [](const volatile void*) {});
}  // namespace

#else

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  palpable::allocation_counter::note();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  palpable::allocation_counter::note();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  palpable::allocation_counter::note();
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  palpable::allocation_counter::note();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  if (alignment < sizeof(void*) || (alignment & (alignment - 1)) != 0) return EINVAL;
  void* const memory = memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *result = memory;
  return 0;
}
}

#endif
