// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/client.hpp"

#include <utility>

#include <boost/asio/buffer.hpp>

namespace palpable::page {
namespace {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

// A client with this many waiting frames is dead or harmful (a scene has three frames).
constexpr std::size_t kMostWaiting = 64;
constexpr std::size_t kLongestReason = 120;

}  // namespace

Client::Client(Channel stream, const ServeOptions& options, Events events)
    : questions(options.question_rate),
      socket_(std::move(stream)),
      rate_(options.rate),
      pings_(options.ping_rate),
      events_(std::move(events)) {
  beast::get_lowest_layer(socket_).expires_never();
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = std::chrono::seconds(5);
  timeout.idle_timeout = milliseconds_of(options.idle_timeout_s);
  timeout.keep_alive_pings = true;
  socket_.set_option(timeout);
  socket_.read_message_max(options.longest_message_bytes);
  // Called within async_read(); a client outlives its pending operations.
  socket_.control_callback([this](websocket::frame_type kind, beast::string_view) {
    if (kind != websocket::frame_type::close) on_control();
  });
}

void Client::accept(const Upgrade& upgrade) {
  socket_.async_accept(upgrade, [self = shared_from_this()](beast::error_code error) {
    if (error || self->closing_) return self->end();
    self->open_ = true;
    self->events_.opened(*self);
    self->read();
  });
}

void Client::read() {
  socket_.async_read(
      buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
}

void Client::on_read(beast::error_code error) {
  if (error) return end();
  const auto data = buffer_.cdata();
  if (!closing_) handle({static_cast<const char*>(data.data()), data.size()});
  buffer_.consume(buffer_.size());
  read();
}

void Client::handle(std::string_view text) {
  switch (rate_.check(seconds_now())) {
    case Verdict::drop:
      return;
    case Verdict::disconnect:
      return close(websocket::close_code::policy_error, "too many messages");
    case Verdict::accept:
      break;
  }
  if (!socket_.got_text()) return close(websocket::close_code::unknown_data, "only text is understood");
  const auto message = protocol::parse_from_page(text);
  if (!message) return close(websocket::close_code::policy_error, message.error().sentence());
  events_.message(*this, *message);
}

// Each ping is answered: without a limit they would keep the server busy.
void Client::on_control() {
  if (pings_.check(seconds_now()) != Verdict::accept)
    close(websocket::close_code::policy_error, "too many pings");
}

void Client::send(SharedFrame frame) {
  if (!open_ || closing_) return;
  if (waiting_.size() >= kMostWaiting) {
    closing_ = true;
    return beast::get_lowest_layer(socket_).close();
  }
  waiting_.push_back(std::move(frame));
  if (waiting_.size() == 1) write_next();
}

bool Client::send_if_idle(const SharedFrame& frame) {
  if (!waiting_.empty()) return false;
  send(frame);
  return true;
}

void Client::write_next() {
  socket_.binary(waiting_.front()->binary);
  socket_.async_write(boost::asio::buffer(waiting_.front()->bytes),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return;  // the pending read fails too
                        self->waiting_.pop_front();
                        if (!self->waiting_.empty() && !self->closing_) self->write_next();
                      });
}

void Client::close(websocket::close_code code, const std::string& reason) {
  if (ended_ || closing_) return;
  closing_ = true;
  if (!open_) return beast::get_lowest_layer(socket_).close();
  websocket::close_reason why(code, reason.substr(0, kLongestReason));
  socket_.async_close(why, [self = shared_from_this()](beast::error_code) { self->end(); });
}

void Client::end() {
  if (ended_) return;
  ended_ = true;
  open_ = false;
  beast::get_lowest_layer(socket_).close();
  events_.closed(*this);
}

}  // namespace palpable::page
