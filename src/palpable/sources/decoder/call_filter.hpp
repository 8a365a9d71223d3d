// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/syscall.h>
#include <unistd.h>

// Sanitizers make calls of their own; for other processors there is no filter.
#if !defined(PALPABLE_SANITIZED) && (defined(__x86_64__) || defined(__aarch64__))
#define PALPABLE_FILTERS_CALLS
#endif

namespace palpable::sources::decoder {

/// A filter of this process's system calls (seccomp). The rules of a call are tried in their order. Jump
/// targets are relative to the next instruction.
class CallFilter {
 public:
#ifdef __aarch64__
  static constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#else
  static constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#endif

  CallFilter() {
    load(offsetof(seccomp_data, arch));
    // Other architectures have other call numbers.
    add(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0);
    give(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
  }
  void allow(long number) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 1);
    give(SECCOMP_RET_ALLOW);
  }
  void refuse(long number, unsigned fault) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 1);
    give(SECCOMP_RET_ERRNO | fault);
  }
  /// Allowed if the argument (its lower half) has all of `wanted` and none of `unwanted`.
  void allow_if(long number, unsigned argument, unsigned wanted, unsigned unwanted) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 5);
    load(static_cast<unsigned>(offsetof(seccomp_data, args) + sizeof(std::uint64_t) * argument));
    add(BPF_ALU | BPF_AND | BPF_K, wanted | unwanted, 0, 0);
    add(BPF_JMP | BPF_JEQ | BPF_K, wanted, 0, 1);
    give(SECCOMP_RET_ALLOW);
    give(SECCOMP_RET_ERRNO | EPERM);
  }
  /// What no rule is about fails like an unknown call, which libraries handle. False: the kernel has no
  /// filter.
  bool install_allowing_only() { return install(SECCOMP_RET_ERRNO | ENOSYS); }
  /// What no rule is about is allowed.
  bool install_refusing_only() { return install(SECCOMP_RET_ALLOW); }

 private:
  bool install(unsigned otherwise) {
    give(otherwise);
    const sock_fprog program{static_cast<unsigned short>(size_), code_.data()};
    return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) == 0;
  }
  void add(unsigned code, unsigned k, unsigned char yes, unsigned char no) {
    code_[size_++] = {static_cast<unsigned short>(code), yes, no, k};
  }
  void load(unsigned at) { add(BPF_LD | BPF_W | BPF_ABS, at, 0, 0); }
  void give(unsigned action) { add(BPF_RET | BPF_K, action, 0, 0); }

  std::array<sock_filter, 256> code_{};
  std::size_t size_ = 0;
};

}  // namespace palpable::sources::decoder
