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

/// Permanently restricts this process: limits of memory, processor time and written bytes; no new
/// descriptors, so that no file or socket can be opened; no core dump; it ends with its parent. If the kernel
/// supports system call filters (seccomp, on x86-64 and AArch64), only the calls for computing, memory and
/// threads remain: no open, socket, exec, new process, or signal to others. Call once, before the file is
/// read, with all descriptors below `next_descriptor`. False: a limit was refused. Sanitizer builds keep the
/// memory and system calls that the sanitizer needs.
bool confine(const Allowance& allowance, int next_descriptor);

}  // namespace palpable::sources::decoder
