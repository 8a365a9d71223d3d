// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/signal_thread.hpp"

#include "palpable/core/system/thread_priority.hpp"

#include <exception>
#include <thread>

#include <pthread.h>
#include <sched.h>

namespace palpable::haptics {

void run_beside_signals(int priority, const std::function<void()>& work) {
  int policy = SCHED_OTHER;
  sched_param before{};
  const bool is_known = pthread_getschedparam(pthread_self(), &policy, &before) == 0;
  std::exception_ptr thrown;
  // It starts before the priority is raised, since a thread inherits that of its creator.
  std::thread thread([&] {
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  if (is_known) static_cast<void>(request_priority(priority));
  thread.join();
  if (is_known) pthread_setschedparam(pthread_self(), policy, &before);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace palpable::haptics
