// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/channel.hpp"
#include "palpable/page/client.hpp"
#include "palpable/page/http.hpp"
#include "palpable/page/pages.hpp"
#include "palpable/page/rate_limit.hpp"
#include "palpable/page/server.hpp"

#include <memory>
#include <optional>
#include <vector>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

namespace palpable::page {

/// What all connections of a port share. Everything runs on the server's thread.
struct ServerContext {
  RequestHandler handler;
  Pages& pages;
  /// Null without a home page.
  ShelfHost* shelf;
  const ServeOptions& options;
  /// Of WebSocket requests with the cookie.
  RateLimit upgrades;
  /// Set for the port of guests, whose connections are encrypted.
  ShareHost* share = nullptr;
  boost::asio::ssl::context* tls = nullptr;
  RateLimit handshakes{{}};
};

/// One HTTP connection, until it is closed or becomes a client of `Pages`. It keeps itself alive while an
/// operation is pending.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Channel stream, boost::asio::ip::address peer, ServerContext& context)
      : stream_(std::move(stream)), peer_(std::move(peer)), context_(context) {}

  /// Begins with the TLS handshake, if there is one.
  void start();
  const boost::asio::ip::address& peer() const { return peer_; }
  /// Whether its last request has shown the cookie, or a token that was exchanged for it.
  bool is_admitted() const { return is_admitted_; }
  /// Ends it at once.
  void abort() { stream_.close(); }

 private:
  void read();
  void read_body();
  void on_header(boost::beast::error_code error);
  void on_read(boost::beast::error_code error);
  /// Whether an error of reading has been dealt with.
  bool is_refused(boost::beast::error_code error);
  void receive_file(const Request& request);
  void receive_part();
  void on_part(boost::beast::error_code error);
  void answer_file();
  void respond(const Client::Upgrade& message);
  void upgrade(const Client::Upgrade& message, const Request& request);
  void write(const Reply& reply, bool keep_alive);
  void write_file(const Reply& reply, bool keep_alive);
  template <class Response>
  void send(Response& response, bool keep_alive);
  void close();

  Channel stream_;
  boost::asio::ip::address peer_;
  ServerContext& context_;
  boost::beast::flat_buffer buffer_;
  /// Of the header, then of the whole request or of a file that is being received.
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> header_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::buffer_body>> file_;
  std::unique_ptr<Upload> upload_;
  std::vector<char> part_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  std::optional<boost::beast::http::response<boost::beast::http::file_body>> file_response_;
  bool is_head_ = false;
  bool is_admitted_ = false;
};

/// The open HTTP connections of a port: at most `most` at once, and `most_of_an_address` of one peer.
class Connections {
 public:
  Connections(std::size_t most, std::size_t most_of_an_address)
      : most_(most), most_of_an_address_(most_of_an_address) {}

  /// Begins to serve a connection. If there are too many (of its peer, or of all), it takes the place of the
  /// oldest one of them that is not admitted, so that strangers cannot keep the browser out; if there is
  /// none, it is dropped. So is a guest's from outside the local network, or beyond the rate of handshakes.
  void add(boost::asio::ip::tcp::socket socket, ServerContext& context);

 private:
  /// Whether there is room for one more of `peer`, or of all peers for null.
  bool make_room(std::size_t most, const boost::asio::ip::address* peer);

  std::size_t most_;
  std::size_t most_of_an_address_;
  /// The oldest first.
  std::vector<std::weak_ptr<Connection>> open_;
};

}  // namespace palpable::page
