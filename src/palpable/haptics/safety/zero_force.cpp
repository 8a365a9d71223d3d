// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/zero_force.hpp"

#include <atomic>
#include <csignal>

#include <poll.h>
#include <pthread.h>

namespace palpable::haptics {
namespace {

// Globals, since a signal handler cannot access anything else.
std::atomic<unsigned> ends{0};
std::atomic<int> running{0};
static_assert(std::atomic<unsigned>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
thread_local device::Device* served = nullptr;

constexpr int kCrashPatience_ms = 50;

void on_crash(int number) {
  end_every_servo(kCrashPatience_ms);
  // The default action is restored: the signal ends the program as usual.
  std::raise(number);
}

}  // namespace

bool end_every_servo(int patience_ms) noexcept {
  ends.fetch_add(1, std::memory_order_acq_rel);
  if (served != nullptr) {
    served->write({});
    served->stop();
    return true;
  }
  for (int waited_ms = 0; running.load(std::memory_order_acquire) > 0; ++waited_ms) {
    if (waited_ms >= patience_ms) return false;
    poll(nullptr, 0, 1);
  }
  return true;
}

void write_zero_force_on_crash() noexcept {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP, SIGQUIT, SIGXCPU,
                           SIGXFSZ, SIGPIPE, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGALRM, SIGIO, SIGPWR}) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = on_crash;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
  // A stopped program would keep its last force on the hand.
  for (const int number : {SIGTSTP, SIGTTIN, SIGTTOU}) {
    struct sigaction now {};
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) std::signal(number, SIG_IGN);
  }
}

RunningServo::RunningServo(device::Device& device) noexcept
    : begun_after_(ends.load(std::memory_order_acquire)) {
  served = &device;
  running.fetch_add(1, std::memory_order_acq_rel);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, number);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

RunningServo::~RunningServo() {
  served = nullptr;
  running.fetch_sub(1, std::memory_order_acq_rel);
}

bool RunningServo::must_end() const noexcept { return ends.load(std::memory_order_relaxed) != begun_after_; }

}  // namespace palpable::haptics
