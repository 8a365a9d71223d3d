// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/device/remote/remote_device.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palpable::device {

/// The client's connection: a thread that takes readings, sends surfaces, and connects again when the
/// connection is lost.
class RemoteLink {
 public:
  struct Address {
    std::string host;
    std::string port;
    std::string token;
  };
  /// Connects and exchanges the token. Errors (device): no connection, refused, no Palpable there.
  static Result<std::unique_ptr<RemoteLink>> open(const Address& address,
                                                  std::shared_ptr<RemoteExchange> exchange);
  /// Takes the surface away, and ends the session.
  ~RemoteLink();
  RemoteLink(const RemoteLink&) = delete;
  RemoteLink& operator=(const RemoteLink&) = delete;

  const Traits& traits() const { return traits_; }
  /// Why there is no connection now; empty if there is one. Any thread.
  std::string trouble() const;

 private:
  using Clock = std::chrono::steady_clock;
  RemoteLink(const Address& address, std::shared_ptr<RemoteExchange> exchange)
      : address_(address), exchange_(std::move(exchange)) {}
  Result<Welcome> connect(const std::string& secret);
  void run();
  void connect_again();
  /// One round of the exchange; false if the connection is lost.
  bool exchange_once();
  bool take_messages();
  void send_textures();
  void note_trouble(std::string sentence);

  Address address_;
  std::shared_ptr<RemoteExchange> exchange_;
  std::string secret_;
  Traits traits_;
  std::optional<TcpStream> stream_;
  MessageReader reader_;
  Clock::time_point heard_;
  Clock::time_point last_take_;
  Clock::time_point last_sent_;
  bool has_news_ = false;
  /// The version of the list of textures that was sent over this connection.
  std::uint32_t sent_textures_ = 0;
  mutable std::mutex mutex_;
  std::string trouble_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace palpable::device
