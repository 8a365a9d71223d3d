// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>

namespace palpable::page {

/// What all connections share. Everything runs on the server's thread.
struct ServerContext {
  RequestHandler handler;
  Pages& pages;
  /// Null without a home page.
  ShelfHost* shelf;
  const ServeOptions& options;
  /// Of WebSocket requests with the cookie.
  RateLimit upgrades;
};

/// One HTTP connection, until it is closed or becomes a client of `Pages`. It keeps itself alive while an
/// operation is pending.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket socket, ServerContext& context)
      : stream_(std::move(socket)), context_(context) {}

  void read();
  /// Whether it has shown the session's cookie or token.
  bool is_admitted() const { return is_admitted_; }
  /// Ends it at once.
  void abort() { stream_.close(); }

 private:
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
  void close();

  boost::beast::tcp_stream stream_;
  ServerContext& context_;
  boost::beast::flat_buffer buffer_;
  /// Of the header, then of the whole request or of a file that is being received.
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> header_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::buffer_body>> file_;
  std::unique_ptr<Upload> upload_;
  std::vector<char> part_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  bool is_head_ = false;
  bool is_admitted_ = false;
};

/// The open HTTP connections, at most `most` at once.
class Connections {
 public:
  explicit Connections(std::size_t most) : most_(most) {}

  /// Begins to serve a connection. If there are too many, it takes the place of the oldest one that has not
  /// been admitted, so that strangers cannot keep the browser out; if there is none, it is dropped.
  void add(boost::asio::ip::tcp::socket socket, ServerContext& context);

 private:
  bool make_room();

  std::size_t most_;
  /// The oldest first.
  std::vector<std::weak_ptr<Connection>> open_;
};

}  // namespace palpable::page
