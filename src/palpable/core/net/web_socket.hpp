// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace palpable {

/// A WebSocket (RFC 6455) of text messages, at either end; without TLS. It has no thread of its own: messages
/// move within receive() and close().
class WebSocket {
 public:
  struct Limits {
    /// A longer message of the peer ends the connection.
    std::size_t message_bytes = std::size_t{1} << 20U;
    /// More than this is not kept for a peer that does not read.
    std::size_t unsent_bytes = std::size_t{1} << 20U;
  };

  /// Connects, and opens the WebSocket, within `longest` each, not counting the look-up of the name. Errors
  /// (device): an unknown name, nobody listens there, no answer in time, no WebSocket.
  static Result<std::unique_ptr<WebSocket>> connect(const std::string& host, const std::string& port,
                                                    std::chrono::milliseconds longest, const Limits& limits);
  /// The server's end of a connection. Errors (device): no WebSocket is asked for in time.
  static Result<std::unique_ptr<WebSocket>> accept(TcpStream stream, std::chrono::milliseconds longest,
                                                   const Limits& limits);
  ~WebSocket();
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  /// The next message; waits for one until `deadline`. nullopt: none came. Errors (failed, without a place):
  /// the connection is lost; "closed the connection". One thread.
  Result<std::optional<std::string>> receive(std::chrono::steady_clock::time_point deadline);
  /// Sends a message after those before it; any thread. False, and nothing is kept: the connection is lost,
  /// or more than Limits::unsent_bytes wait.
  bool send(std::string text);
  /// Bytes that the system has not taken yet; any thread.
  std::size_t unsent_bytes() const;
  /// Sends what waits, for at most `longest`, and closes. The thread of receive().
  void close(std::chrono::milliseconds longest);

 private:
  struct Impl;
  explicit WebSocket(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpable
