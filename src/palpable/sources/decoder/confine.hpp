// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable::sources::decoder {

/// The resources that a decoder process may use.
struct Allowance {
  std::uint64_t memory_bytes = 0;
  std::uint64_t written_bytes = 0;
  std::uint64_t processor_s = 0;
};

/// Restricts this process permanently: limits on memory, processor time and written bytes; no further
/// descriptors, so that no file and no socket can be opened; no core dump; its end with its parent's. Where
/// the kernel filters system calls (seccomp, on x86-64 and AArch64), only those remain that computing,
/// memory and threads need: no open, no socket, no exec, no new process, no signal to others. Call once,
/// before anything of the file is read, with all descriptors below `next_descriptor`. False: a limit was
/// refused. Builds with a sanitizer keep the memory and the system calls that it needs.
bool confine(const Allowance& allowance, int next_descriptor);

}  // namespace palpable::sources::decoder
