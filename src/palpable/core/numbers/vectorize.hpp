// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Compiles a function with a hot loop also for AVX2 and AVX-512; the version is chosen at start-up for the
/// processor. The project does not use -march=native. The macro is empty in sanitizer builds, because
/// sanitizers run before the version could be chosen.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(PALPABLE_SANITIZED)
#define PALPABLE_VECTORIZE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PALPABLE_VECTORIZE
#endif

/// Before a loop: its iterations are independent, so the compiler need not check whether the arrays overlap
/// (it gives up if there are many). The arrays must not overlap.
#if defined(__GNUC__) && !defined(__clang__)
#define PALPABLE_INDEPENDENT _Pragma("GCC ivdep")
#else
#define PALPABLE_INDEPENDENT
#endif
