// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/signal_thread.hpp"

#include "palpable/core/system/thread_priority.hpp"

#include <atomic>
#include <csignal>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

namespace palpable::haptics {
namespace {

// Globals, since a signal handler cannot access anything else.
std::atomic<int> taken_by{0};
std::atomic<int> taken_with_policy{-1};

void note_signal(int /*number*/) {
  taken_with_policy = sched_getscheduler(0);
  taken_by = gettid();
  taken_by.notify_all();
}

bool may_use_real_time() {
  bool may = false;
  std::thread([&may] { may = request_priority(1).starts_with("SCHED_FIFO"); }).join();
  return may;
}

TEST(SignalThread, TakesSignalsWithRealTimePriorityWhileTheWorkHasNone) {
  const auto before = std::signal(SIGUSR1, note_signal);
  int worker = 0;
  int worker_policy = -1;
  run_beside_signals(79, [&] {
    worker = gettid();
    // The calling thread raises its priority after this thread has started.
    while (may_use_real_time() && sched_getscheduler(getpid()) == SCHED_OTHER) std::this_thread::yield();
    worker_policy = sched_getscheduler(0);
    kill(getpid(), SIGUSR1);
    taken_by.wait(0);
  });
  std::signal(SIGUSR1, before);
  EXPECT_EQ(taken_by, getpid());
  EXPECT_NE(worker, getpid());
  EXPECT_EQ(worker_policy, SCHED_OTHER);
  EXPECT_EQ(taken_with_policy, may_use_real_time() ? SCHED_FIFO : SCHED_OTHER);
  EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER) << "the priority is that of before";
}

TEST(SignalThread, PassesAnExceptionOn) {
  EXPECT_THROW(run_beside_signals(0, [] { throw std::runtime_error("of the work"); }), std::runtime_error);
}

}  // namespace
}  // namespace palpable::haptics
