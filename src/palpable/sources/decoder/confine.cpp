// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/confine.hpp"

#include "palpable/sources/decoder/call_filter.hpp"
#include "palpable/sources/decoder/process_limits.hpp"

#include <array>
#include <cerrno>
#include <csignal>

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace palpable::sources::decoder {
namespace {

#ifndef PALPABLE_FILTERS_CALLS

void filter_system_calls() {}

#else

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

/// Without seccomp in the kernel only the limits above remain, which still prevent opening files.
void filter_system_calls() {
  CallFilter filter;
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
  static_cast<void>(filter.install_allowing_only());
}

#endif

}  // namespace

bool confine(const Allowance& allowance, int next_descriptor) {
  // The parent may have ended before this call; then nobody waits for a reply.
  const pid_t parent = getppid();
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent || parent == 1) return false;
  give_up_rights();
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
