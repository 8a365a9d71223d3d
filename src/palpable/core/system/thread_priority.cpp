// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/thread_priority.hpp"

#include <cstring>

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

namespace palpable {

std::string request_priority(int priority) {
  // Otherwise the kernel may wake a thread without real-time priority up to 50 µs late to save power.
  prctl(PR_SET_TIMERSLACK, 1UL);
  if (priority <= 0) return "normal (not requested)";
  sched_param wanted{};
  wanted.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
  if (error != 0) return std::string("ordinary (") + std::strerror(error) + ")";
  return "SCHED_FIFO " + std::to_string(priority);
}

}  // namespace palpable
