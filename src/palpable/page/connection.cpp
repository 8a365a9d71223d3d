// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/connection.hpp"

#include "palpable/page/protocol.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
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

constexpr std::size_t kPartBytes = 65536;
constexpr auto kLongestDownload = std::chrono::hours(1);
// An absent limit counts as one of zero bytes in Boost 1.74.
constexpr auto kUnlimited = std::numeric_limits<std::uint64_t>::max();

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

template <class Message>
Request request_of(const Message& message, std::string_view body) {
  return {view(message.method_string()),         view(message.target()),
          view(message[http::field::host]),      view(message[http::field::origin]),
          view(message[http::field::cookie]),    body,
          view(message[http::field::user_agent])};
}

template <class Response>
void set_head(Response& response, const Reply& reply) {
  response.result(reply.status);
  response.version(11);
  for (const auto& header : kSafetyHeaders) response.set(header.name, header.value);
  response.set("Content-Security-Policy", std::string(kContentPolicy) + std::string(reply.permissions));
}

/// Why no page can be added now; empty if one can. A touch that has begun since the last frame counts. A
/// guest's page always can: it takes the place of the guest's former one.
std::string obstacle_to_a_page(ServerContext& context) {
  if (context.share != nullptr) return {};
  if (context.shelf != nullptr) context.pages.show(context.shelf->touch());
  return context.pages.obstacle();
}

}  // namespace

void Connection::start() {
  stream_.expires_after(milliseconds_of(context_.options.handshake_timeout_s));
  stream_.async_handshake([self = shared_from_this()](beast::error_code error) {
    if (error) return self->abort();
    self->read();
  });
}

void Connection::read() {
  buffer_.max_size(kBufferBytes);
  header_.emplace();
  header_->header_limit(kLongestHeaderBytes);
  // Checked when it is known what the body is.
  header_->body_limit(kUnlimited);
  is_head_ = false;
  stream_.expires_after(milliseconds_of(context_.options.idle_timeout_s));
  http::async_read_header(
      stream_, buffer_, *header_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_header(error); });
}

bool Connection::is_refused(beast::error_code error) {
  if (!error) return false;
  if (error == http::error::end_of_stream || error == asio::error::operation_aborted) {
    close();
  } else if (error == http::error::body_limit) {
    write({413, "text/plain", "The request is too long.", {}, {}}, false);
  } else if (error == http::error::header_limit) {
    write({431, "text/plain", "The request is too long.", {}, {}}, false);
  } else if (error.category() == http::make_error_code(http::error::bad_method).category()) {
    write({400, "text/plain", "The request is not HTTP.", {}, {}}, false);
  } else {
    close();
  }
  return true;
}

void Connection::on_header(beast::error_code error) {
  if (is_refused(error)) return;
  is_head_ = header_->get().method() == http::verb::head;
  const Request request = request_of(header_->get(), {});
  if (context_.handler.is_upload(request)) return receive_file(request);
  read_body();
}

void Connection::read_body() {
  if (header_->content_length().value_or(0) > context_.options.longest_message_bytes)
    return write({413, "text/plain", "The request is too long.", {}, {}}, false);
  parser_.emplace(std::move(*header_));
  parser_->body_limit(context_.options.longest_message_bytes);
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
}

void Connection::on_read(beast::error_code error) {
  if (!is_refused(error)) respond(parser_->get());
}

void Connection::receive_file(const Request& request) {
  if (const Reply refusal = context_.handler.check_upload(request); refusal.status != 200)
    return write(refusal, false);
  is_admitted_ = true;
  const auto bytes = header_->content_length();
  if (!bytes) return write({411, "text/plain", "The length of the file is missing.", {}, {}}, false);
  auto upload = context_.shelf->begin_upload(request.target.substr(kUploadPath.size()), *bytes);
  if (!upload) return write({409, "text/plain", upload.error().sentence(), {}, {}}, false);
  upload_ = *std::move(upload);
  file_.emplace(std::move(*header_));
  file_->body_limit(kUnlimited);
  part_.resize(kPartBytes);
  receive_part();
}

void Connection::receive_part() {
  stream_.expires_after(milliseconds_of(context_.options.idle_timeout_s));
  file_->get().body().data = part_.data();
  file_->get().body().size = part_.size();
  http::async_read(
      stream_, buffer_, *file_,
      [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_part(error); });
}

void Connection::on_part(beast::error_code error) {
  if (error && error != http::error::need_buffer) {
    upload_.reset();
    return close();
  }
  const std::size_t bytes = part_.size() - file_->get().body().size;
  if (const auto stored = upload_->write({part_.data(), bytes}); !stored) {
    upload_.reset();
    return write({507, "text/plain", stored.error().sentence(), {}, {}}, false);
  }
  if (file_->is_done()) return answer_file();
  receive_part();
}

void Connection::answer_file() {
  const bool keep_alive = file_->get().keep_alive();
  const auto done = upload_->finish();
  upload_.reset();
  file_.reset();
  if (!done) return write({507, "text/plain", done.error().sentence(), {}, {}}, false);
  write({200, "application/json", protocol::write_message(*done), {}, {}}, keep_alive);
}

void Connection::respond(const Client::Upgrade& message) {
  const Request request = request_of(message, message.body());
  if (beast::websocket::is_upgrade(message)) return upgrade(message, request);
  Reply reply = context_.handler.answer(request);
  is_admitted_ = context_.handler.admits(request) || !reply.set_cookie.empty();
  // Not for a browser that only comes in, at a home page.
  if (request.target == kSessionPath && reply.status == 204 &&
      (context_.shelf == nullptr || request.method == "GET"))
    if (std::string obstacle = obstacle_to_a_page(context_); !obstacle.empty()) {
      reply.status = 503;
      reply.body = std::move(obstacle);
    }
  write(reply, message.keep_alive());
}

void Connection::upgrade(const Client::Upgrade& message, const Request& request) {
  const Reply reply = context_.handler.check_upgrade(request);
  if (reply.status != 101) return write(reply, false);
  const Guest* guest =
      context_.share == nullptr ? nullptr : context_.share->guest_of(context_.handler.secret_of(request));
  if (guest == nullptr ? context_.upgrades.check(seconds_now()) != Verdict::accept
                       : !context_.share->may_open(guest->number))
    return write({429, "text/plain", "The page is opened too often: wait a few seconds.", {}, {}}, false);
  if (std::string obstacle = obstacle_to_a_page(context_); !obstacle.empty())
    return write({503, "text/plain", std::move(obstacle), {}, {}}, false);
  context_.pages.add_client(std::move(stream_), message,
                            guest == nullptr ? std::nullopt : std::optional(*guest));
}

void Connection::write(const Reply& reply, bool keep_alive) {
  if (!reply.file.empty()) return write_file(reply, keep_alive);
  response_ = {};
  set_head(response_, reply);
  if (!reply.body.empty()) response_.set(http::field::content_type, reply.media_type);
  if (!reply.location.empty()) response_.set(http::field::location, reply.location);
  if (!reply.set_cookie.empty()) response_.set(http::field::set_cookie, reply.set_cookie);
  response_.body() = reply.body;
  response_.prepare_payload();
  if (is_head_) response_.body().clear();
  send(response_, keep_alive);
}

void Connection::write_file(const Reply& reply, bool keep_alive) {
  http::file_body::value_type file;
  beast::error_code error;
  file.open(reply.file.c_str(), beast::file_mode::scan, error);
  if (error) return write({404, "text/plain", "This file is no longer there.", {}, {}}, keep_alive);
  const auto set_file_head = [&](auto& response) {
    set_head(response, reply);
    // Its bytes come from a scene: never shown as a page of this server.
    response.set(http::field::content_type, "application/octet-stream");
    response.set(http::field::content_disposition, "attachment");
    response.content_length(file.size());
  };
  if (is_head_) {
    response_ = {};
    set_file_head(response_);
    return send(response_, keep_alive);
  }
  file_response_.emplace();
  set_file_head(*file_response_);
  file_response_->body() = std::move(file);
  // A browser may ask the person first where the file goes.
  stream_.expires_after(kLongestDownload);
  send(*file_response_, keep_alive);
}

template <class Response>
void Connection::send(Response& response, bool keep_alive) {
  response.keep_alive(keep_alive);
  http::async_write(stream_, response,
                    [self = shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
                      self->file_response_.reset();
                      if (error || !keep_alive) return self->close();
                      self->read();
                    });
}

void Connection::close() { stream_.shut_down(); }

void Connections::add(tcp::socket socket, ServerContext& context) {
  beast::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  if (error) return;
  const asio::ip::address peer = endpoint.address();
  if (context.share != nullptr && !context.share->is_local(peer.to_string())) return;
  if (context.tls != nullptr && context.handshakes.check(seconds_now()) != Verdict::accept) return;
  std::erase_if(open_, [](const auto& one) { return one.expired(); });
  if (!make_room(most_of_an_address_, &peer) || !make_room(most_, nullptr)) return;
  Channel channel =
      context.tls == nullptr ? Channel(std::move(socket)) : Channel(std::move(socket), *context.tls);
  const auto connection = std::make_shared<Connection>(std::move(channel), peer, context);
  open_.push_back(connection);
  connection->start();
}

bool Connections::make_room(std::size_t most, const asio::ip::address* peer) {
  const auto counts = [&](const std::weak_ptr<Connection>& one) {
    const auto connection = one.lock();
    return connection != nullptr && (peer == nullptr || connection->peer() == *peer);
  };
  if (static_cast<std::size_t>(std::count_if(open_.begin(), open_.end(), counts)) < most) return true;
  const auto stranger = std::find_if(
      open_.begin(), open_.end(), [&](const auto& one) { return counts(one) && !one.lock()->is_admitted(); });
  if (stranger == open_.end()) return false;
  if (const auto connection = stranger->lock()) connection->abort();
  open_.erase(stranger);
  return true;
}

}  // namespace palpable::page
