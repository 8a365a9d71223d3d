// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/confine_network.hpp"

#include "palpable/sources/decoder/call_filter.hpp"
#include "palpable/sources/decoder/process_limits.hpp"

#include <array>
#include <cstdlib>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace palpable::sources::decoder {
namespace {

/// What the look-up of names, certificates and the loader of libraries read.
constexpr std::array kReadable{"/etc/hosts",
                               "/etc/host.conf",
                               "/etc/resolv.conf",
                               "/etc/nsswitch.conf",
                               "/etc/gai.conf",
                               "/etc/services",
                               "/etc/protocols",
                               "/etc/ld.so.cache",
                               "/etc/localtime",
                               "/etc/ssl/certs",
                               "/etc/ssl/openssl.cnf",
                               "/etc/pki",
                               "/etc/gnutls",
                               "/etc/mdns.allow",
                               "/usr/share/ca-certificates",
                               "/usr/local/share/ca-certificates",
                               "/usr/lib",
                               "/usr/lib64",
                               "/usr/share/zoneinfo",
                               "/run/systemd/resolve",
                               "/run/NetworkManager",
                               "/run/resolvconf",
                               "/run/nscd",
                               "/run/avahi-daemon",
                               "/dev/null",
                               "/dev/urandom",
                               "/proc/sys/crypto"};

/// All kinds of access of Landlock's first version: reading is allowed below `kReadable`, the others nowhere.
constexpr std::uint64_t kAllKinds = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1;
constexpr std::uint64_t kReading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;

void allow_reading(int rules, const char* path) {
  const int place = ::open(path, O_PATH | O_CLOEXEC);
  // What is not there cannot be read either.
  if (place < 0) return;
  landlock_path_beneath_attr below{kReading, place};
  // A single file has no entries.
  if (syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0) != 0) {
    below.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
    syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0);
  }
  ::close(place);
}

void hide_files() {
  landlock_ruleset_attr kinds{};
  kinds.handled_access_fs = kAllKinds;
  const auto rules =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &kinds, sizeof kinds.handled_access_fs, 0));
  if (rules < 0) return;
  for (const char* path : kReadable) allow_reading(rules, path);
  if (const char* authorities = std::getenv("SSL_CERT_FILE"); authorities != nullptr)
    allow_reading(rules, authorities);
  syscall(SYS_landlock_restrict_self, rules, 0);
  ::close(rules);
}

#ifndef PALPABLE_FILTERS_CALLS

void filter_system_calls() {}

#else

/// Other programs and processes, servers, the kernel's less used parts.
constexpr std::array kRefused{SYS_execve,
                              SYS_execveat,
                              SYS_ptrace,
                              SYS_process_vm_readv,
                              SYS_process_vm_writev,
                              SYS_kill,
                              SYS_tkill,
                              SYS_pidfd_send_signal,
                              SYS_pidfd_getfd,
                              SYS_pidfd_open,
                              SYS_listen,
                              SYS_accept,
                              SYS_accept4,
                              SYS_bpf,
                              SYS_perf_event_open,
                              SYS_userfaultfd,
                              SYS_io_uring_setup,
                              SYS_io_uring_enter,
                              SYS_io_uring_register,
                              SYS_keyctl,
                              SYS_add_key,
                              SYS_request_key,
                              SYS_mount,
                              SYS_umount2,
                              SYS_setns,
                              SYS_unshare,
                              SYS_chroot,
                              SYS_shmget,
                              SYS_shmat,
                              SYS_msgget,
                              SYS_semget,
                              SYS_memfd_create,
                              SYS_name_to_handle_at,
                              SYS_open_by_handle_at,
                              SYS_mq_open,
                              SYS_unlinkat,
                              SYS_mkdirat,
                              SYS_fchmodat,
                              SYS_fchownat,
                              SYS_fchmod,
                              SYS_fchown,
                              SYS_truncate,
                              SYS_utimensat};

void filter_system_calls() {
  CallFilter filter;
  for (const long number : kRefused) filter.refuse(number, EPERM);
  // The libraries use the older calls then, whose arguments can be judged.
  filter.refuse(SYS_clone3, ENOSYS);
  filter.refuse(SYS_openat2, ENOSYS);
  filter.allow_if(SYS_clone, 0, CLONE_THREAD, 0);
  filter.allow_if(SYS_openat, 2, O_RDONLY, O_WRONLY | O_RDWR | O_CREAT | O_TRUNC);
#ifdef __x86_64__
  for (const long number : {SYS_fork, SYS_vfork, SYS_creat, SYS_unlink, SYS_rename, SYS_chmod})
    filter.refuse(number, EPERM);
  filter.allow_if(SYS_open, 1, O_RDONLY, O_WRONLY | O_RDWR | O_CREAT | O_TRUNC);
#endif
  static_cast<void>(filter.install_refusing_only());
}

#endif

}  // namespace

bool confine_to_network(std::uint64_t memory_bytes) {
  give_up_rights();
  constexpr rlim_t kDescriptors = 64;
  bool limited = limit(RLIMIT_FSIZE, 0, 0) && limit(RLIMIT_NOFILE, kDescriptors, kDescriptors) &&
                 limit(RLIMIT_CORE, 0, 0);
#ifndef PALPABLE_SANITIZED
  limited = limited && limit(RLIMIT_AS, memory_bytes, memory_bytes);
#endif
  if (!limited) return false;
  hide_files();
  filter_system_calls();
  return true;
}

}  // namespace palpable::sources::decoder
