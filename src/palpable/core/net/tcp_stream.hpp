// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palpable {

/// A TCP connection that neither reads nor writes with waiting, and sends small messages at once. One thread.
class TcpStream {
 public:
  /// A connected socket.
  explicit TcpStream(Descriptor socket);

  /// Connects within `longest`, not counting the look-up of the name. Errors (device): an unknown name,
  /// nobody listens there, no answer in time.
  static Result<TcpStream> connect(const std::string& host, const std::string& port,
                                   std::chrono::milliseconds longest);

  /// Sends all bytes, or keeps those that the system does not take yet for flush().
  void send(std::span<const std::byte> bytes);
  /// Sends bytes that were kept.
  void flush() { send({}); }
  /// Whether all bytes so far have left this machine's buffers: a message that was put behind others would
  /// arrive late, and a newer one is better.
  bool has_sent_all() const;
  /// Appends what has arrived, at most `most` bytes. False if the connection is lost.
  bool receive(std::vector<std::byte>& bytes, std::size_t most);
  bool is_lost() const { return lost_; }
  int descriptor() const { return socket_.number(); }
  /// The socket, for another owner; nothing may have been received or kept.
  Descriptor release() { return std::move(socket_); }
  /// Leaves time for the bytes so far to be read, at most `longest`, and closes.
  void close_after_sending(std::chrono::milliseconds longest);

 private:
  Descriptor socket_;
  std::vector<std::byte> unsent_;
  bool lost_ = false;
};

/// Accepts TCP connections at an address of this machine.
class TcpListener {
 public:
  /// `address`: numeric ("127.0.0.1", "0.0.0.0", "::"); port 0: any free one. Errors: usage (no such
  /// address), failed (the port is in use).
  static Result<TcpListener> open(const std::string& address, std::uint16_t port);
  std::optional<TcpStream> accept();
  std::uint16_t port() const { return port_; }
  int descriptor() const { return socket_.number(); }

 private:
  TcpListener(Descriptor socket, std::uint16_t port) : socket_(std::move(socket)), port_(port) {}
  Descriptor socket_;
  std::uint16_t port_;
};

inline constexpr std::size_t kMostWaitedFor = 18;

/// Waits until one of these descriptors, at most kMostWaitedFor, can be read, at most this long; -1 is none.
void wait_for_any(std::span<const int> descriptors, std::chrono::milliseconds longest);

}  // namespace palpable
