// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

namespace palpable::device {

/// A longer message ends the connection.
inline constexpr std::size_t kLongestInverse3Message_bytes = 1U << 20U;

/// Connects to a port of this machine. A program that accepts no connection is not waited for any longer.
boost::system::error_code connect_within(boost::asio::io_context& context,
                                         boost::asio::ip::tcp::socket& socket, std::uint16_t port,
                                         std::chrono::milliseconds longest);

/// Sends one command over a connection of its own and waits for it to be read, a fifth of a second at most: a
/// broken connection takes no zero force any more, and the service may hold the last one. False: not read.
bool send_anew(std::uint16_t port, const std::string& command);

}  // namespace palpable::device
