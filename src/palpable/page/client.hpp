// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/language.hpp"
#include "palpable/page/channel.hpp"
#include "palpable/page/host_changes.hpp"
#include "palpable/page/protocol.hpp"
#include "palpable/page/rate_limit.hpp"
#include "palpable/page/server.hpp"

#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>

namespace palpable::page {

/// A time in seconds as Asio takes it.
inline std::chrono::milliseconds milliseconds_of(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
}

/// The connection to one page over a WebSocket. It keeps itself alive while an operation is pending.
/// Everything runs on the server's thread.
class Client : public std::enable_shared_from_this<Client> {
 public:
  using Upgrade = boost::beast::http::request<boost::beast::http::string_body>;
  /// Called on the server's thread.
  struct Events {
    std::function<void(Client&)> opened;
    std::function<void(Client&, const protocol::FromPage&)> message;
    std::function<void(Client&)> closed;
  };

  Client(Channel stream, const ServeOptions& options, Events events);

  void accept(const Upgrade& upgrade);
  /// Queues a frame. A client whose queue grows too long is disconnected.
  void send(SharedFrame frame);
  /// Sends a frame only if the queue is empty, since the next state replaces it; returns whether it was sent.
  bool send_if_idle(const SharedFrame& frame);
  /// Closes the connection with a reason of at most 120 bytes; one that is not accepted yet, without.
  void close(boost::beast::websocket::close_code code, const std::string& reason);

  /// `hello.page`; set by the server.
  std::int64_t page = 0;
  bool visible = true;
  /// Of the answers to its questions.
  describe::Language language = describe::Language::english;
  /// It follows the head of who sits before it.
  bool follows_head = false;
  /// A state was skipped: the next one is sent even if nothing has changed.
  bool is_behind = true;
  /// The probes that this page has moved and not yet lifted.
  std::bitset<protocol::kMostProbes> moved;
  /// Whose page it is; nullopt for a page of this machine.
  std::optional<Guest> guest;
  /// Of a guest's questions.
  RateLimit questions;

 private:
  void read();
  void on_read(boost::beast::error_code error);
  void handle(std::string_view text);
  void on_control();
  void write_next();
  void end();

  boost::beast::websocket::stream<Channel> socket_;
  boost::beast::flat_buffer buffer_;
  std::deque<SharedFrame> waiting_;
  RateLimit rate_;
  RateLimit pings_;
  Events events_;
  bool open_ = false;
  bool closing_ = false;
  bool ended_ = false;
};

}  // namespace palpable::page
