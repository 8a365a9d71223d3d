// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/inverse3/inverse3_socket.hpp"

#include <functional>
#include <optional>

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

namespace palpable::device {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

boost::system::error_code connect_within(asio::io_context& context, asio::ip::tcp::socket& socket,
                                         std::uint16_t port, std::chrono::milliseconds longest) {
  std::optional<beast::error_code> outcome;
  socket.async_connect({asio::ip::address_v4::loopback(), port},
                       [&](beast::error_code error) { outcome = error; });
  context.run_for(longest);
  const bool in_time = outcome.has_value();
  if (!in_time) {
    beast::error_code ignored;
    socket.close(ignored);
    context.run();
  }
  context.restart();
  return in_time ? *outcome : beast::error_code(asio::error::timed_out);
}

bool send_anew(std::uint16_t port, const std::string& command) {
  asio::io_context context;
  websocket::stream<asio::ip::tcp::socket> socket(context);
  beast::flat_buffer buffer;
  // The list of devices, and the answer: a connection that is closed before may take the command along.
  int awaited = 2;
  std::function<void()> read = [&] {
    socket.async_read(buffer, [&](beast::error_code error, std::size_t) {
      if (!error && --awaited > 0) return read();
      context.stop();
    });
  };
  socket.next_layer().async_connect({asio::ip::address_v4::loopback(), port}, [&](beast::error_code failed) {
    if (failed) return;
    socket.read_message_max(kLongestInverse3Message_bytes);
    socket.async_handshake("localhost:" + std::to_string(port), "/", [&](beast::error_code refused) {
      if (refused) return;
      socket.text(true);
      socket.async_write(asio::buffer(command), [](beast::error_code, std::size_t) {});
      read();
    });
  });
  context.run_for(std::chrono::milliseconds(200));
  return awaited == 0;
}

}  // namespace palpable::device
