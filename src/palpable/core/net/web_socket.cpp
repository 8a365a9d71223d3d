// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/net/web_socket.hpp"

#include <atomic>
#include <deque>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <sys/socket.h>

namespace palpable {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using SocketClock = std::chrono::steady_clock;
using SocketError = beast::error_code;

/// What a peer did that ended the connection by this error.
std::string what_peer_did(const SocketError& error, const WebSocket::Limits& limits) {
  if (error == beast::websocket::error::message_too_big)
    return "sends a message of more than " + std::to_string(limits.message_bytes >> 10U) + " KiB";
  const bool closed = error == beast::websocket::error::closed || error == asio::error::eof ||
                      error == asio::error::connection_reset || error == asio::error::broken_pipe;
  return closed ? "closed the connection" : "breaks the protocol of WebSockets (" + error.message() + ")";
}

bool is_ipv6(int socket) {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size);
  return own.ss_family == AF_INET6;
}

}  // namespace

struct WebSocket::Impl {
  explicit Impl(const Limits& wanted) : limits(wanted), socket(context) {}

  void adopt(TcpStream stream) {
    Descriptor descriptor = stream.release();
    const auto protocol = is_ipv6(descriptor.number()) ? asio::ip::tcp::v6() : asio::ip::tcp::v4();
    SocketError failed;
    socket.next_layer().assign(protocol, descriptor.number(), failed);
    if (!failed) descriptor.release();
    auto timeout = beast::websocket::stream_base::timeout::suggested(beast::role_type::server);
    // The user of this class decides when silence lasts too long.
    timeout.idle_timeout = beast::websocket::stream_base::none();
    socket.set_option(timeout);
    socket.read_message_max(limits.message_bytes);
    socket.text(true);
  }

  /// Whether the handshake that `start` begins succeeds in time. After an error this is to be destroyed.
  template <class Start>
  Result<void> shake_hands(std::chrono::milliseconds longest, Start start) {
    std::optional<SocketError> outcome;
    start([&outcome](SocketError error) { outcome = error; });
    run_until(SocketClock::now() + longest, [&] { return outcome.has_value(); });
    if (!outcome) return Error{ErrorCode::device, "opens no WebSocket in time", {}};
    if (*outcome) return Error{ErrorCode::device, "opens no WebSocket (" + outcome->message() + ")", {}};
    return {};
  }

  void drop() {
    SocketError ignored;
    socket.next_layer().close(ignored);
  }

  void lose(const SocketError& error) {
    if (lost) return;
    ending = what_peer_did(error, limits);
    lost = true;
    drop();
  }

  void read() {
    if (reading || lost) return;
    reading = true;
    socket.async_read(buffer, [this](SocketError error, std::size_t) {
      reading = false;
      if (error) return lose(error);
      message = beast::buffers_to_string(buffer.data());
      buffer.consume(buffer.size());
    });
  }

  void write() {
    if (writing || lost || waiting.empty()) return;
    writing = true;
    socket.async_write(asio::buffer(waiting.front()), [this](SocketError error, std::size_t) {
      writing = false;
      unsent -= waiting.front().size();
      waiting.pop_front();
      if (error) return lose(error);
      write();
    });
  }

  /// Lets operations happen until `done`, or the deadline; what is ready happens in any case.
  template <class Done>
  void run_until(SocketClock::time_point deadline, Done done) {
    context.restart();
    context.poll();
    while (!done() && SocketClock::now() < deadline) {
      context.restart();
      context.run_one_until(deadline);
    }
  }

  Limits limits;
  asio::io_context context;
  beast::websocket::stream<asio::ip::tcp::socket> socket;
  beast::flat_buffer buffer;
  std::optional<std::string> message;
  std::deque<std::string> waiting;
  bool reading = false;
  bool writing = false;
  bool closed = false;
  std::atomic<bool> lost{false};
  std::atomic<std::size_t> unsent{0};
  std::string ending;
};

WebSocket::WebSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

WebSocket::~WebSocket() { impl_->drop(); }

Result<std::unique_ptr<WebSocket>> WebSocket::connect(const std::string& host, const std::string& port,
                                                      std::chrono::milliseconds longest,
                                                      const Limits& limits) {
  auto stream = TcpStream::connect(host, port, longest);
  if (!stream) return std::move(stream).error();
  auto impl = std::make_unique<Impl>(limits);
  impl->adopt(*std::move(stream));
  const std::string authority = host + ":" + port;
  if (auto opened = impl->shake_hands(
          longest, [&](auto done) { impl->socket.async_handshake(authority, "/", std::move(done)); });
      !opened)
    return Error{ErrorCode::device, opened.error().message, authority};
  return std::unique_ptr<WebSocket>(new WebSocket(std::move(impl)));
}

Result<std::unique_ptr<WebSocket>> WebSocket::accept(TcpStream stream, std::chrono::milliseconds longest,
                                                     const Limits& limits) {
  auto impl = std::make_unique<Impl>(limits);
  impl->adopt(std::move(stream));
  if (auto opened =
          impl->shake_hands(longest, [&](auto done) { impl->socket.async_accept(std::move(done)); });
      !opened)
    return std::move(opened).error();
  return std::unique_ptr<WebSocket>(new WebSocket(std::move(impl)));
}

Result<std::optional<std::string>> WebSocket::receive(SocketClock::time_point deadline) {
  Impl& link = *impl_;
  link.read();
  link.run_until(deadline, [&] { return link.message || link.lost; });
  if (link.message) return std::exchange(link.message, std::nullopt);
  if (link.lost) return Error{ErrorCode::failed, link.ending, {}};
  return std::optional<std::string>();
}

bool WebSocket::send(std::string text) {
  Impl& link = *impl_;
  const std::size_t size = text.size();
  if (link.lost || link.unsent + size > link.limits.unsent_bytes) return false;
  link.unsent += size;
  asio::post(link.context, [&link, text = std::move(text)]() mutable {
    link.waiting.push_back(std::move(text));
    link.write();
  });
  return true;
}

std::size_t WebSocket::unsent_bytes() const { return impl_->unsent; }

void WebSocket::close(std::chrono::milliseconds longest) {
  Impl& link = *impl_;
  const auto deadline = SocketClock::now() + longest;
  link.run_until(deadline, [&] { return link.unsent == 0 || link.lost; });
  if (link.lost) return;
  link.socket.async_close(beast::websocket::close_code::normal, [&link](SocketError) { link.closed = true; });
  link.run_until(deadline, [&] { return link.closed; });
  if (!link.lost) link.ending = "was closed";
  link.lost = true;
  link.drop();
}

}  // namespace palpable
