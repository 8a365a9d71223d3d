// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/core/net/web_socket.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::sources {

/// A rosbridge server for tests: it keeps what a client sends, and sends what the test wants.
class TestRosbridgeServer {
 public:
  explicit TestRosbridgeServer(std::uint16_t port = 0) : listener_(*TcpListener::open("127.0.0.1", port)) {
    thread_ = std::thread([this] { run(); });
  }
  ~TestRosbridgeServer() {
    ending_ = true;
    thread_.join();
  }
  TestRosbridgeServer(const TestRosbridgeServer&) = delete;
  TestRosbridgeServer& operator=(const TestRosbridgeServer&) = delete;

  std::uint16_t port() const { return listener_.port(); }
  /// To the client that is connected, or the next one.
  void send(std::string text) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(text));
  }
  void hang_up() { hangs_up_ = true; }
  /// Whether a client has sent a text that contains this, within ten seconds.
  bool has_heard(const std::string& part) const {
    for (int n = 0; n < 2000; ++n, std::this_thread::sleep_for(std::chrono::milliseconds(5)))
      if (has_heard_by_now(part)) return true;
    return false;
  }
  bool has_heard_by_now(const std::string& part) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(heard_.begin(), heard_.end(),
                       [&](const auto& text) { return text.find(part) != std::string::npos; });
  }

 private:
  void run() {
    while (!ending_) {
      wait_for_any(std::array{listener_.descriptor()}, std::chrono::milliseconds(5));
      auto stream = listener_.accept();
      if (!stream) continue;
      constexpr WebSocket::Limits kLimits{std::size_t{1} << 24U, std::size_t{1} << 26U};
      auto socket = WebSocket::accept(*std::move(stream), std::chrono::seconds(5), kLimits);
      if (socket) serve(**socket);
    }
  }
  void serve(WebSocket& socket) {
    while (!ending_ && !hangs_up_.exchange(false)) {
      {
        const std::lock_guard lock(mutex_);
        for (auto& text : std::exchange(waiting_, {})) socket.send(std::move(text));
      }
      auto text = socket.receive(std::chrono::steady_clock::now() + std::chrono::milliseconds(2));
      if (!text) return;
      if (!*text) continue;
      const std::lock_guard lock(mutex_);
      heard_.push_back(**std::move(text));
    }
  }

  TcpListener listener_;
  mutable std::mutex mutex_;
  std::vector<std::string> waiting_, heard_;
  std::atomic<bool> hangs_up_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpable::sources
