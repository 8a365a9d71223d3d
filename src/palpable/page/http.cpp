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

/// One browser of this machine, by the printed address.
class OwnEntrance final : public Entrance {
 public:
  explicit OwnEntrance(SessionAccess access) : access_(std::move(access)) {}

  bool admits(std::string_view secret) const override { return access_.admits(secret); }
  bool renews(std::string_view) const override { return false; }
  Result<std::string> exchange(std::string_view token, std::string_view) override {
    if (std::string secret = access_.exchange(token); !secret.empty()) return secret;
    return invalid_input(access_.used()
                             ? "This address was used already: it gives access to one browser, once. "
                               "Start palpable again for a new one."
                             : "This address is not the one that palpable printed.");
  }
  std::string no_access() const override {
    return "This browser has no access to the session: open the address that palpable printed.";
  }
  std::string not_from_here() const override {
    return "This server answers only requests from its own page on this machine.";
  }

 private:
  SessionAccess access_;
};

/// Guests, by one-time links.
class GuestEntrance final : public Entrance {
 public:
  explicit GuestEntrance(ShareHost& share) : share_(share) {}

  bool admits(std::string_view secret) const override { return share_.guest_of(secret) != nullptr; }
  bool renews(std::string_view token) const override { return share_.offers(token); }
  Result<std::string> exchange(std::string_view token, std::string_view agent) override {
    return share_.join(token, agent);
  }
  std::string no_access() const override {
    return "This device has no access to the scene: ask the person who shares it for a new link.";
  }
  std::string not_from_here() const override {
    return "This server answers only requests from its own page, at the address of the link.";
  }

 private:
  ShareHost& share_;
};

}  // namespace

RequestHandler::RequestHandler(SessionAccess access, std::uint16_t port, ShelfHost* shelf)
    : entrance_(std::make_unique<OwnEntrance>(std::move(access))),
      names_(loopback_names(port)),
      port_(port),
      shelf_(shelf) {}

RequestHandler::RequestHandler(ShareHost& share, std::uint16_t port)
    : entrance_(std::make_unique<GuestEntrance>(share)),
      names_(guest_names(share.addresses(), port)),
      port_(port),
      shelf_(nullptr) {}

Reply RequestHandler::no_access() const { return reply_with(401, entrance_->no_access()); }

Reply RequestHandler::not_from_here() const { return reply_with(403, entrance_->not_from_here()); }

// A browser sends the Origin of every POST and WebSocket.
bool RequestHandler::is_own(const Request& request) const {
  return is_own_host(request.host, names_) && is_own_origin(request.origin, names_);
}

// Browsers share cookies between the ports of a host, so the name contains the port.
std::string RequestHandler::cookie_name() const { return "palpable_" + std::to_string(port_); }

std::string_view RequestHandler::secret_of(const Request& request) const {
  return cookie_value(request.cookies, cookie_name());
}

bool RequestHandler::admits(const Request& request) const { return entrance_->admits(secret_of(request)); }

Reply RequestHandler::answer(const Request& request) {
  if (!is_own_host(request.host, names_)) return not_from_here();
  if (!request.origin.empty() && !is_own_origin(request.origin, names_)) return not_from_here();
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
  for (const auto& [path, answer] : {std::pair(kPicturePath, &RequestHandler::shelf_picture),
                                     std::pair(kSavedPath, &RequestHandler::saved_file)})
    if (request.target.starts_with(path))
      return admits(request) ? (this->*answer)(request.target.substr(path.size())) : no_access();
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

Reply RequestHandler::shelf_picture(std::string_view name) {
  auto picture = shelf_->picture(name);
  if (!picture) return reply_with(404, "There is no such picture.");
  return Reply{200, "image/png", *std::move(picture), {}, {}};
}

Reply RequestHandler::saved_file(std::string_view name) {
  auto file = shelf_->saved_file(name);
  if (!file) return reply_with(404, "This file is no longer there: save the scene again.");
  Reply reply;
  reply.file = *std::move(file);
  return reply;
}

Reply RequestHandler::check_own(const Request& request) {
  if (!is_own(request)) return not_from_here();
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
  const bool is_exchange = request.method == "POST";
  // A browser with the cookie may reload the printed address.
  if (admits(request) && !(is_exchange && entrance_->renews(request.body))) return reply_with(204, {});
  if (!is_exchange) return no_access();
  const auto secret = entrance_->exchange(request.body, request.agent);
  if (!secret) return reply_with(403, secret.error().message);
  Reply reply = reply_with(204, {});
  reply.set_cookie = cookie_name() + "=" + *secret + "; Path=/; SameSite=Strict; HttpOnly";
  if (names_.scheme == "https") reply.set_cookie += "; Secure";
  return reply;
}

Reply RequestHandler::check_upgrade(const Request& request) const {
  if (!is_own(request)) return not_from_here();
  if (request.target != kSocketPath) return reply_with(404, "There is no WebSocket at this address.");
  if (!admits(request)) return no_access();
  return reply_with(101, {});
}

}  // namespace palpable::page
