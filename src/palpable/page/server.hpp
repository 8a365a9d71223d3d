// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/rate_limit.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace palpable::page {

struct ServeOptions {
  /// 0 = any free one.
  std::uint16_t port = 0;
  double states_per_s = 60.0;
  std::size_t most_clients = 4;
  std::size_t most_connections = 32;
  std::size_t longest_message_bytes = 4096;
  RateLimits rate;
  /// A connection that sends nothing is closed after this; pages answer pings within it.
  double idle_timeout_s = 20.0;
  /// Called once, from the calling thread, when the page can be opened: its address, token included.
  std::function<void(const std::string& address)> on_ready;
};

/// Serves the page on 127.0.0.1 until `stop`, and returns within a fifth of a second of it. Runs in the
/// calling thread alone; the host is called from there only. Errors: the port is in use or may not be taken.
Result<void> serve(PageHost& host, const ServeOptions& options, const std::atomic<bool>& stop);

}  // namespace palpable::page
