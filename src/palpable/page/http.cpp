// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/http.hpp"

#include "palpable/page/assets.hpp"

namespace palpable::page {
namespace {

Reply reply_with(unsigned status, std::string text) {
  Reply reply;
  reply.status = status;
  reply.body = std::move(text);
  return reply;
}

Reply no_access() {
  return reply_with(401,
                    "This browser has no access to the session: open the address that palpable printed.");
}

Reply not_from_here() {
  return reply_with(403, "This server answers only requests from its own page on this machine.");
}

}  // namespace

// Browsers share cookies between the ports of a host, so the name contains the port.
std::string RequestHandler::cookie_name() const { return "palpable_" + std::to_string(port_); }

bool RequestHandler::admits(const Request& request) const {
  return access_.admits(cookie_value(request.cookies, cookie_name()));
}

Reply RequestHandler::answer(const Request& request) {
  if (!is_own_host(request.host, port_)) return not_from_here();
  if (!request.origin.empty() && !is_own_origin(request.origin, port_)) return not_from_here();
  if (request.target == kSessionPath) return session(request);
  if (request.target == kSocketPath) return reply_with(426, "This address is for WebSockets.");
  if (request.method != "GET" && request.method != "HEAD")
    return reply_with(405, "This method is not supported here.");
  const Asset* asset = find_asset(request.target);
  if (asset == nullptr) return reply_with(404, "There is no such file in Palpable's page.");
  return {200, std::string(asset->media_type), std::string(asset->bytes), {}};
}

Reply RequestHandler::session(const Request& request) {
  if (request.method != "GET" && request.method != "POST")
    return reply_with(405, "This method is not supported here.");
  // A browser with the cookie may reload the printed address.
  if (admits(request)) return reply_with(204, {});
  if (request.method == "GET") return no_access();
  const std::string secret = access_.exchange(request.body);
  if (!secret.empty()) {
    Reply reply = reply_with(204, {});
    reply.set_cookie = cookie_name() + "=" + secret + "; Path=/; SameSite=Strict; HttpOnly";
    return reply;
  }
  return reply_with(403, access_.used()
                             ? "This address was used already: it gives access to one browser, once. "
                               "Start palpable again for a new one."
                             : "This address is not the one that palpable printed.");
}

Reply RequestHandler::check_upgrade(const Request& request) const {
  // A browser always sends the Origin of a WebSocket request.
  if (!is_own_host(request.host, port_) || !is_own_origin(request.origin, port_)) return not_from_here();
  if (request.target != kSocketPath) return reply_with(404, "There is no WebSocket at this address.");
  if (!admits(request)) return no_access();
  return reply_with(101, {});
}

}  // namespace palpable::page
