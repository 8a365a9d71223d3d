// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/confine.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace palpable::sources::decoder {
namespace {

bool limit(__rlimit_resource_t resource, rlim_t soft, rlim_t hard) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return false;
  // Never above the limit that the user set.
  const rlimit wanted{soft < now.rlim_max ? soft : now.rlim_max, hard < now.rlim_max ? hard : now.rlim_max};
  return setrlimit(resource, &wanted) == 0;
}

#if defined(PALPABLE_SANITIZED) || !(defined(__x86_64__) || defined(__aarch64__))

void filter_system_calls() {}

#else

#ifdef __x86_64__
constexpr unsigned kArchitecture = AUDIT_ARCH_X86_64;
#else
constexpr unsigned kArchitecture = AUDIT_ARCH_AARCH64;
#endif

/// Calls for computing, memory, threads, and reading and writing open descriptors.
constexpr std::array kAllowed{SYS_read,
                              SYS_write,
                              SYS_readv,
                              SYS_writev,
                              SYS_pread64,
                              SYS_pwrite64,
                              SYS_lseek,
                              SYS_close,
                              SYS_fstat,
                              SYS_ftruncate,
                              SYS_munmap,
                              SYS_mremap,
                              SYS_madvise,
                              SYS_brk,
                              SYS_futex,
                              SYS_sched_yield,
                              SYS_sched_getaffinity,
                              SYS_getpid,
                              SYS_gettid,
                              SYS_clock_gettime,
                              SYS_clock_nanosleep,
                              SYS_nanosleep,
                              SYS_gettimeofday,
                              SYS_getrandom,
                              SYS_getrusage,
                              SYS_times,
                              SYS_uname,
                              SYS_sysinfo,
                              SYS_rt_sigaction,
                              SYS_rt_sigprocmask,
                              SYS_rt_sigreturn,
                              SYS_sigaltstack,
                              SYS_set_robust_list,
                              SYS_rseq,
                              SYS_exit,
                              SYS_exit_group,
                              SYS_restart_syscall};

/// The filter's program. Jump targets are relative to the next instruction.
class Filter {
 public:
  Filter() {
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
  /// All other calls fail like unknown ones, which libraries handle.
  bool install() {
    give(SECCOMP_RET_ERRNO | ENOSYS);
    const sock_fprog program{static_cast<unsigned short>(size_), code_.data()};
    return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) == 0;
  }

 private:
  void add(unsigned code, unsigned k, unsigned char yes, unsigned char no) {
    code_[size_++] = {static_cast<unsigned short>(code), yes, no, k};
  }
  void load(unsigned at) { add(BPF_LD | BPF_W | BPF_ABS, at, 0, 0); }
  void give(unsigned action) { add(BPF_RET | BPF_K, action, 0, 0); }

  std::array<sock_filter, 256> code_{};
  std::size_t size_ = 0;
};

/// Without seccomp in the kernel only the limits above remain, which still prevent opening files.
void filter_system_calls() {
  Filter filter;
  for (const long number : kAllowed) filter.allow(number);
  // Memory that is not executable; threads, but no processes.
  filter.allow_if(SYS_mmap, 2, 0, PROT_EXEC);
  filter.allow_if(SYS_mprotect, 2, 0, PROT_EXEC);
  filter.allow_if(SYS_clone, 0, CLONE_THREAD, 0);
  // abort() sends its signal to a thread of this process.
  filter.allow(SYS_tgkill);
  for (const long number : {SYS_openat, SYS_newfstatat, SYS_readlinkat, SYS_faccessat})
    filter.refuse(number, EACCES);
#ifdef __x86_64__
  for (const long number : {SYS_open, SYS_stat, SYS_lstat, SYS_access, SYS_readlink})
    filter.refuse(number, EACCES);
#endif
  static_cast<void>(filter.install());
}

#endif

}  // namespace

bool confine(const Allowance& allowance, int next_descriptor) {
  // The parent may have ended before this call; then nobody waits for a reply.
  const pid_t parent = getppid();
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent || parent == 1) return false;
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_DUMPABLE, 0);
  bool limited =
      limit(RLIMIT_CPU, allowance.processor_s, allowance.processor_s + 1) &&
      limit(RLIMIT_FSIZE, allowance.written_bytes, allowance.written_bytes) &&
      limit(RLIMIT_NOFILE, static_cast<rlim_t>(next_descriptor), static_cast<rlim_t>(next_descriptor)) &&
      limit(RLIMIT_CORE, 0, 0);
#ifndef PALPABLE_SANITIZED
  limited = limited && limit(RLIMIT_AS, allowance.memory_bytes, allowance.memory_bytes);
#endif
  if (limited) filter_system_calls();
  return limited;
}

}  // namespace palpable::sources::decoder
