// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/http.hpp"

#include "palpable/page/assets.hpp"
#include "palpable/page/protocol.hpp"

#include <utility>

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
  if (shelf_ != nullptr)
    if (auto reply = shelf_answer(request)) return *std::move(reply);
  if (request.method != "GET" && request.method != "HEAD")
    return reply_with(405, "This method is not supported here.");
  const Asset* asset = find_asset(request.target);
  if (asset == nullptr) return reply_with(404, "There is no such file in Palpable's page.");
  Reply reply{200, std::string(asset->media_type), std::string(asset->bytes), {}, {}};
  if (asset->path.starts_with(kFaceWorkerPath)) reply.permissions = kFaceWorkerPermissions;
  return reply;
}

std::optional<Reply> RequestHandler::shelf_answer(const Request& request) {
  if (request.target == kShelfPath) return shelf_message(request);
  if (request.method != "GET" && request.method != "HEAD") return std::nullopt;
  if (request.target.starts_with(kPicturePath)) {
    if (!admits(request)) return no_access();
    auto picture = shelf_->picture(request.target.substr(kPicturePath.size()));
    if (!picture) return reply_with(404, "There is no such picture.");
    return Reply{200, "image/png", *std::move(picture), {}, {}};
  }
  std::string_view page;
  if (request.target == "/") page = "/shelf.html";
  if (request.target == kTouchPath) {
    if (shelf_->touch() == nullptr) {
      Reply reply = reply_with(303, "No scene is being touched.");
      reply.location = "/";
      return reply;
    }
    page = "/index.html";
  }
  const Asset* asset = page.empty() ? nullptr : find_asset(page);
  if (asset == nullptr) return std::nullopt;
  return Reply{200, std::string(asset->media_type), std::string(asset->bytes), {}, {}};
}

Reply RequestHandler::check_own(const Request& request) {
  // A browser sends the Origin of every POST.
  if (!is_own_host(request.host, port_) || !is_own_origin(request.origin, port_)) return not_from_here();
  if (request.method != "POST") return reply_with(405, "This method is not supported here.");
  if (!admits(request)) return no_access();
  if (shelf_rate_.check(seconds_now()) != Verdict::accept)
    return reply_with(429, "The home page asks too often: wait a few seconds.");
  return {};
}

Reply RequestHandler::shelf_message(const Request& request) {
  if (Reply refusal = check_own(request); refusal.status != 200) return refusal;
  const auto message = protocol::parse_from_shelf(request.body);
  if (!message) return reply_with(400, message.error().sentence());
  auto answer = shelf_->answer(*message);
  if (!answer) return reply_with(409, answer.error().sentence());
  return {200, "application/json", *std::move(answer), {}, {}};
}

bool RequestHandler::is_upload(const Request& request) const {
  return shelf_ != nullptr && request.target.starts_with(kUploadPath);
}

Reply RequestHandler::check_upload(const Request& request) { return check_own(request); }

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
