// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/share_host.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <utility>
#include <variant>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace palpable::page {

/// The TLS settings of a server with this certificate: TLS 1.2 or newer, without renegotiation and
/// resumption. Errors: failed, if OpenSSL refuses the certificate.
Result<std::unique_ptr<boost::asio::ssl::context>> tls_context(const ServerCertificate& certificate);

/// One connection, plain or over TLS: an asynchronous stream as Beast expects it, with the time limits of
/// tcp_stream. One thread.
class Channel {
 public:
  using Plain = boost::beast::tcp_stream;
  using Tls = boost::beast::ssl_stream<Plain>;
  using executor_type = Plain::executor_type;

  explicit Channel(boost::asio::ip::tcp::socket socket) : stream_(Plain(std::move(socket))) {}
  /// To be used after handshake(); `context` outlives this.
  Channel(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context& context)
      : stream_(std::in_place_type<Tls>, std::move(socket), context) {}

  executor_type get_executor() noexcept { return tcp().get_executor(); }
  void expires_after(std::chrono::milliseconds time) { tcp().expires_after(time); }
  void expires_never() { tcp().expires_never(); }
  void close() { tcp().close(); }
  /// Sends what is left, and no more.
  void shut_down() {
    boost::beast::error_code ignored;
    tcp().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  }

  /// Calls `done` with an error code: at once for a plain connection.
  template <class Done>
  void async_handshake(Done done) {
    if (auto* tls = std::get_if<Tls>(&stream_)) {
      tls->async_handshake(boost::asio::ssl::stream_base::server, std::move(done));
    } else {
      done(boost::beast::error_code());
    }
  }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    std::visit([&](auto& stream) { stream.async_read_some(buffers, std::forward<Handler>(handler)); },
               stream_);
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    std::visit([&](auto& stream) { stream.async_write_some(buffers, std::forward<Handler>(handler)); },
               stream_);
  }

  // What Beast calls at the end of a WebSocket. Its own closing frames were exchanged before, so that TLS
  // need not be ended in addition.
  friend void beast_close_socket(Channel& channel) { channel.close(); }
  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, Channel& channel, Handler&& handler) {
    boost::beast::websocket::async_teardown(role, channel.tcp().socket(), std::forward<Handler>(handler));
  }

 private:
  Plain& tcp() {
    if (auto* tls = std::get_if<Tls>(&stream_)) return tls->next_layer();
    return std::get<Plain>(stream_);
  }

  std::variant<Plain, Tls> stream_;
};

}  // namespace palpable::page
