// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace palpable::page {

/// The value of the cookie `name` in a Cookie header's value; empty if it is absent.
std::string_view cookie_value(std::string_view header, std::string_view name);

/// Whether a request's Host and Origin are this server's own: a loopback name with its port. Another Host
/// means DNS rebinding; another Origin means a foreign page in the same browser.
bool is_own_host(std::string_view host, std::uint16_t port);
bool is_own_origin(std::string_view origin, std::uint16_t port);

}  // namespace palpable::page
