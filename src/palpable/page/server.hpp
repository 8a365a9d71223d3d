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
  /// 0 = any free port.
  std::uint16_t port = 0;
  double states_per_s = 60.0;
  std::size_t most_clients = 4;
  std::size_t most_connections = 32;
  std::size_t longest_message_bytes = 4096;
  RateLimits rate;
  /// An idle connection is closed after this time; pages answer pings within it.
  double idle_timeout_s = 20.0;
  /// Called once on the calling thread with the page's address, token included, when the page can be opened.
  std::function<void(const std::string& address)> on_ready;
};

/// Serves the page on 127.0.0.1 until `stop` is set, and returns within 0.2 s after that. Runs on the calling
/// thread alone, which also calls the host. Errors: the port is in use or not permitted.
Result<void> serve(PageHost& host, const ServeOptions& options, const std::atomic<bool>& stop);

}  // namespace palpable::page
