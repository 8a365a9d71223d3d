// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks a hot loop's function to be compiled for AVX2 and AVX-512 too, chosen at start-up by the processor.
/// There is no -march=native in this project, and sanitizers run before the choice could be made: there the
/// macro is empty.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(PALPABLE_SANITIZED)
#define PALPABLE_VECTORIZE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define PALPABLE_VECTORIZE
#endif

/// Before a loop: its turns are independent, so the compiler need not check whether many arrays overlap (it
/// gives up beyond a few). The arrays must not overlap.
#if defined(__GNUC__) && !defined(__clang__)
#define PALPABLE_INDEPENDENT _Pragma("GCC ivdep")
#else
#define PALPABLE_INDEPENDENT
#endif
