// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page {

/// The value of the cookie `name` in a Cookie header's value; empty if it is absent.
std::string_view cookie_value(std::string_view header, std::string_view name);

/// How a server is called by the browsers that it serves.
struct OwnNames {
  /// "http" or "https".
  std::string scheme;
  /// "127.0.0.1:4711".
  std::vector<std::string> hosts;
};

/// The names of a server that listens on loopback, without TLS; and of one for guests, at IP addresses.
OwnNames loopback_names(std::uint16_t port);
/// An IP address with a port, as in an address of the web: "10.0.0.1:4711", "[fd00::2]:4711".
std::string host_and_port(const std::string& address, std::uint16_t port);
OwnNames guest_names(const std::vector<std::string>& addresses, std::uint16_t port);

/// Whether a request's Host and Origin are the server's own. Another Host means DNS rebinding; another Origin
/// means a foreign page in the same browser.
bool is_own_host(std::string_view host, const OwnNames& names);
bool is_own_origin(std::string_view origin, const OwnNames& names);

}  // namespace palpable::page
