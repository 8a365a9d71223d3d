// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/rate_limit.hpp"
#include "palpable/page/share_host.hpp"
#include "palpable/page/shelf_host.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace palpable::page {

struct ServeOptions {
  /// 0 = any free port.
  std::uint16_t port = 0;
  /// Rate at which the host is polled for changes; and the rate after a second without changes, at least 10.
  double states_per_s = 60.0;
  double rest_updates_per_s = 20.0;
  std::size_t most_clients = 4;
  /// HTTP connections. Beyond them, a new one takes the place of the oldest one that has not shown the
  /// cookie.
  std::size_t most_connections = 32;
  std::size_t longest_message_bytes = 4096;
  /// Messages of one page.
  RateLimits rate;
  /// Pings and pongs of one page; it is disconnected beyond them.
  RateLimits ping_rate{1.0, 20.0, 0};
  /// New WebSockets of the session; beyond them they are refused with status 429.
  RateLimits upgrade_rate{2.0, 20.0, 0};
  /// An idle connection is closed after this time; pages answer pings within it.
  double idle_timeout_s = 20.0;
  /// Shares the touch with guests in the local network; null: it is not shared.
  ShareHost* share = nullptr;
  /// Guests' connections that are not a page's WebSocket: all, and of one address.
  std::size_t most_guest_connections = 32;
  std::size_t most_connections_of_an_address = 8;
  /// TLS handshakes that are begun; and the time that each may take.
  RateLimits handshake_rate{50.0, 100.0, 0};
  double handshake_timeout_s = 5.0;
  /// Questions of one guest; more of them are not answered.
  RateLimits question_rate{20.0, 40.0, 1000};
  /// Called once on the calling thread with the page's address, token included, when the page can be opened.
  std::function<void(const std::string& address)> on_ready;
};

/// Serves the page on 127.0.0.1 until `stop` is set, and returns within 0.2 s after that. Runs on the calling
/// thread alone, which also calls the hosts. Errors: a port is in use or not permitted.
Result<void> serve(PageHost& host, const ServeOptions& options, const std::atomic<bool>& stop);

/// The same with a home page at /, and at /touch the page of the touch that it leads to, if there is one.
Result<void> serve_shelf(ShelfHost& shelf, const ServeOptions& options, const std::atomic<bool>& stop);

}  // namespace palpable::page
