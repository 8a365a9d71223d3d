// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/system/secret.hpp"
#include "palpable/device/remote/remote_wire.hpp"
#include "palpable/device/remote/shared_device.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace palpable::device {

struct HostOptions {
  /// The address of this machine at which to listen, in numbers; with the default only programs of this
  /// machine can connect.
  std::string address = "127.0.0.1";
  /// 0: any free one.
  std::uint16_t port = 0;
  /// Of the shared device.
  Traits traits;
  /// Limits a surface to what this computer's device can render; by the host's thread.
  std::function<LocalSurface(const LocalSurface&)> limited;
  /// Called by the host's thread with each texture that came; false for values that no texture has. May be
  /// empty.
  std::function<bool(const LocalTexture&)> on_texture;
  /// Called by the host's thread with a sentence about who came, went or was refused; may be empty.
  std::function<void(const std::string&)> on_news;
};

/// Serves a shared device to one client at a time, by a thread. A client proves by the token of the address
/// that it may; the token is for one session, in which a client whose connection was lost may come back. What
/// a client sends is not believed: the first message that is none, or that is out of range, ends its session
/// with a sentence, and so do more than kMostMessages a second. A client that was gone before its first
/// message may use the token again, since it may not know how to come back. After a wrong token the next
/// connection has to wait for kWrongTokenWait; those that came before it are heard. kMostVisitors may wait to
/// be heard at the same time; the first of them goes if more come.
class RemoteHost {
 public:
  static constexpr int kMostMessages = 3000;
  static constexpr std::size_t kMostVisitors = 16;
  static constexpr std::chrono::milliseconds kHelloWithin{1000};
  static constexpr std::chrono::milliseconds kWrongTokenWait{500};
  /// A client that was lost for this long has gone, and a new token is made.
  static constexpr std::chrono::milliseconds kForgottenAfter{60'000};

  /// Errors: usage (no such address), failed (the port is in use, no random numbers).
  static Result<std::unique_ptr<RemoteHost>> open(HostOptions options,
                                                  std::shared_ptr<SharedExchange> exchange);
  /// Says good-bye to the client.
  ~RemoteHost();
  RemoteHost(const RemoteHost&) = delete;
  RemoteHost& operator=(const RemoteHost&) = delete;

  std::uint16_t port() const { return listener_.port(); }
  /// The token of the next session. Any thread.
  std::string token() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Client {
    explicit Client(TcpStream opened) : stream(std::move(opened)), since(Clock::now()), heard(since) {}
    TcpStream stream;
    MessageReader reader;
    Clock::time_point since;
    Clock::time_point heard;
    Clock::time_point second;
    int in_this_second = 0;
  };

  RemoteHost(HostOptions options, std::shared_ptr<SharedExchange> exchange, TcpListener listener)
      : options_(std::move(options)), exchange_(std::move(exchange)), listener_(std::move(listener)) {}
  void run();
  void wait();
  void accept();
  void greet();
  /// Takes what a visitor said; false if it stays one.
  bool greet(Client& visitor);
  void admit(Client visitor, const std::string& secret);
  void refuse(Client& visitor, Refusal refusal, const std::string& why);
  void serve();
  /// Takes what the client sent; a sentence if it ends the session, empty if not.
  std::string take_messages();
  std::string take(const Message& message);
  void end_session(const std::string& why);
  Result<void> renew_token();
  void tell(const std::string& sentence) const;

  HostOptions options_;
  std::shared_ptr<SharedExchange> exchange_;
  TcpListener listener_;
  std::optional<Client> client_;
  /// The client has sent a message in this session, so it knows how to come back.
  bool confirmed_ = false;
  /// Have not said yet who they are, in the order in which they came.
  std::vector<Client> visitors_;
  Clock::time_point accepts_from_;
  Clock::time_point lost_since_;
  std::string secret_;
  std::optional<SessionAccess> access_;
  mutable std::mutex mutex_;
  std::string token_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace palpable::device
