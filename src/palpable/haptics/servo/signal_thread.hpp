// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace palpable::haptics {

/// Runs `work` on a new thread and returns after it. Meanwhile the calling thread only takes signals, with
/// SCHED_FIFO at `priority` where that is allowed, so that other threads cannot delay the signal handlers
/// that end a servo. Call it on the program's first thread: Linux delivers a signal for the whole program to
/// that thread first. Threads and processes that `work` starts inherit neither the priority nor a signal
/// mask. An exception of `work` is thrown again. Not for the tick path.
void run_beside_signals(int priority, const std::function<void()>& work);

}  // namespace palpable::haptics
