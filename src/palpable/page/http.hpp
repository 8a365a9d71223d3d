// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/secret.hpp"
#include "palpable/page/access.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace palpable::page {

/// The parts of a request that the server uses; views into the request.
struct Request {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  /// Empty if the header is absent.
  std::string_view origin;
  std::string_view cookies;
  std::string_view body;
};

struct Reply {
  unsigned status = 200;
  std::string media_type = "text/plain; charset=utf-8";
  std::string body;
  /// The value of Set-Cookie; empty for none.
  std::string set_cookie;
};

/// The path of the WebSocket, and of the exchange of the token for the cookie.
constexpr std::string_view kSocketPath = "/socket";
constexpr std::string_view kSessionPath = "/session";

/// Answers HTTP requests. Not thread-safe.
class RequestHandler {
 public:
  RequestHandler(SessionAccess access, std::uint16_t port) : access_(std::move(access)), port_(port) {}

  /// The answer to an ordinary request: the page's files, and the exchange of the token.
  Reply answer(const Request& request);
  /// Status 101 if this request may become a WebSocket, else the refusal.
  Reply check_upgrade(const Request& request) const;
  /// Whether the request shows the session's cookie.
  bool admits(const Request& request) const;

 private:
  Reply session(const Request& request);
  std::string cookie_name() const;

  SessionAccess access_;
  std::uint16_t port_;
};

/// Security headers of every response: what the page may load, and that nothing is cached.
struct Header {
  const char* name;
  const char* value;
};
constexpr Header kSafetyHeaders[] = {
    {"Content-Security-Policy",
     "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; object-src 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Cache-Control", "no-store"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
};

}  // namespace palpable::page
