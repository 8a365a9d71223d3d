// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/connection.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace palpable::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using tcp = boost::asio::ip::tcp;

constexpr std::size_t kLongestHeaderBytes = 8192;
constexpr std::size_t kBufferBytes = kLongestHeaderBytes + 65536;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

void Connection::read() {
  buffer_.max_size(kBufferBytes);
  parser_.emplace();
  parser_->header_limit(kLongestHeaderBytes);
  parser_->body_limit(context_.options.longest_message_bytes);
  stream_.expires_after(milliseconds_of(context_.options.idle_timeout_s));
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
}

void Connection::on_read(beast::error_code error) {
  if (error == http::error::end_of_stream || error == asio::error::operation_aborted) return close();
  if (error == http::error::body_limit)
    return write({413, "text/plain", "The request is too long.", {}}, false);
  if (error == http::error::header_limit)
    return write({431, "text/plain", "The request is too long.", {}}, false);
  if (error.category() == http::make_error_code(http::error::bad_method).category())
    return write({400, "text/plain", "The request is not HTTP.", {}}, false);
  if (error) return close();
  respond(parser_->get());
}

void Connection::respond(const Client::Upgrade& message) {
  const Request request{view(message.method_string()),      view(message.target()),
                        view(message[http::field::host]),   view(message[http::field::origin]),
                        view(message[http::field::cookie]), message.body()};
  if (beast::websocket::is_upgrade(message)) return upgrade(message, request);
  Reply reply = context_.handler.answer(request);
  is_admitted_ = is_admitted_ || context_.handler.admits(request) || !reply.set_cookie.empty();
  if (request.target == kSessionPath && reply.status == 204 && context_.pages.full()) {
    reply.status = 503;
    reply.body = context_.pages.full_sentence();
  }
  write(reply, message.keep_alive());
}

void Connection::upgrade(const Client::Upgrade& message, const Request& request) {
  const Reply reply = context_.handler.check_upgrade(request);
  if (reply.status != 101) return write(reply, false);
  if (context_.upgrades.check(seconds_now()) != Verdict::accept)
    return write({429, "text/plain", "The page is opened too often: wait a few seconds.", {}}, false);
  if (context_.pages.full()) return write({503, "text/plain", context_.pages.full_sentence(), {}}, false);
  context_.pages.add_client(std::move(stream_), message);
}

void Connection::write(const Reply& reply, bool keep_alive) {
  const bool head = parser_->get().method() == http::verb::head;
  response_ = {};
  response_.result(reply.status);
  response_.version(11);
  for (const auto& header : kSafetyHeaders) response_.set(header.name, header.value);
  if (!reply.body.empty()) response_.set(http::field::content_type, reply.media_type);
  if (!reply.set_cookie.empty()) response_.set(http::field::set_cookie, reply.set_cookie);
  response_.keep_alive(keep_alive);
  response_.body() = reply.body;
  response_.prepare_payload();
  if (head) response_.body().clear();
  http::async_write(stream_, response_,
                    [self = shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
                      if (error || !keep_alive) return self->close();
                      self->read();
                    });
}

void Connection::close() {
  beast::error_code ignored;
  stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
}

void Connections::add(tcp::socket socket, ServerContext& context) {
  if (!make_room()) return;
  const auto connection = std::make_shared<Connection>(std::move(socket), context);
  open_.push_back(connection);
  connection->read();
}

bool Connections::make_room() {
  std::erase_if(open_, [](const auto& one) { return one.expired(); });
  if (open_.size() < most_) return true;
  const auto stranger = std::find_if(open_.begin(), open_.end(), [](const auto& one) {
    const auto connection = one.lock();
    return connection != nullptr && !connection->is_admitted();
  });
  if (stranger == open_.end()) return false;
  if (const auto connection = stranger->lock()) connection->abort();
  open_.erase(stranger);
  return true;
}

}  // namespace palpable::page
