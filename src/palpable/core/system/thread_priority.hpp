// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace palpable {

/// The SCHED_FIFO priority that the servo loop and the threads of drivers that carry its forces ask for. They
/// have the same one: neither may hold up the other for longer than its own message or tick.
inline constexpr int kForcePriority = 80;

/// Requests SCHED_FIFO at `priority` (0 = no request) for the calling thread, and timer wake-ups without
/// slack. Returns what was granted: "SCHED_FIFO 80", or why not: "ordinary (Operation not permitted)".
std::string request_priority(int priority);

}  // namespace palpable
