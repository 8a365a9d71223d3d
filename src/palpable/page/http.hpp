// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/secret.hpp"
#include "palpable/page/access.hpp"
#include "palpable/page/rate_limit.hpp"
#include "palpable/page/share_host.hpp"
#include "palpable/page/shelf_host.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
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
  /// User-Agent: the browser's own description, not trusted.
  std::string_view agent = {};
};

struct Reply {
  unsigned status = 200;
  std::string media_type = "text/plain; charset=utf-8";
  std::string body;
  /// The value of Set-Cookie; empty for none.
  std::string set_cookie;
  /// The value of Location; empty for none.
  std::string location;
  /// Further permissions in its Content-Security-Policy; empty for none.
  std::string_view permissions = {};
  /// A file that is sent instead of the body, for the browser to keep, not to show; empty for none.
  std::filesystem::path file = {};
};

/// The path of the WebSocket, and of the exchange of the token for the cookie.
constexpr std::string_view kSocketPath = "/socket";
constexpr std::string_view kSessionPath = "/session";
/// Of a server with a home page: messages of it, files that it sends (the name follows), pictures of scenes
/// and files that scenes were saved as (likewise), and the page of the touch.
constexpr std::string_view kShelfPath = "/shelf";
constexpr std::string_view kUploadPath = "/upload/";
constexpr std::string_view kPicturePath = "/picture/";
constexpr std::string_view kSavedPath = "/saved/";
constexpr std::string_view kTouchPath = "/touch";

/// Who is let in, by the exchange of a token for the secret of a cookie.
class Entrance {
 public:
  Entrance() = default;
  Entrance(const Entrance&) = delete;
  Entrance& operator=(const Entrance&) = delete;
  virtual ~Entrance() = default;

  virtual bool admits(std::string_view secret) const = 0;
  /// Whether a browser that has access gets another one for this token.
  virtual bool renews(std::string_view token) const = 0;
  /// The secret for a token, once. Errors: a sentence for the person.
  virtual Result<std::string> exchange(std::string_view token, std::string_view agent) = 0;
  /// For a browser without a secret, and for one that calls the server by another name.
  virtual std::string no_access() const = 0;
  virtual std::string not_from_here() const = 0;
};

/// Answers HTTP requests. Not thread-safe.
class RequestHandler {
 public:
  /// For the pages of this machine. `shelf`: null for a server without a home page; else it outlives this.
  RequestHandler(SessionAccess access, std::uint16_t port, ShelfHost* shelf = nullptr);
  /// For guests. `share` outlives this.
  RequestHandler(ShareHost& share, std::uint16_t port);

  /// The answer to an ordinary request: the page's files, and the exchange of the token.
  Reply answer(const Request& request);
  /// Status 101 if this request may become a WebSocket, else the refusal.
  Reply check_upgrade(const Request& request) const;
  /// Whether the request sends a file to the home page. Its body is not read by answer().
  bool is_upload(const Request& request) const;
  /// Status 200 if this request may send a file, else the refusal.
  Reply check_upload(const Request& request);
  /// Whether the request shows the cookie of the session, or of a guest.
  bool admits(const Request& request) const;
  /// The secret in that cookie; empty if there is none.
  std::string_view secret_of(const Request& request) const;

 private:
  Reply session(const Request& request);
  Reply no_access() const;
  Reply not_from_here() const;
  bool is_own(const Request& request) const;
  std::optional<Reply> shelf_answer(const Request& request);
  Reply shelf_picture(std::string_view name);
  Reply saved_file(std::string_view name);
  Reply shelf_message(const Request& request);
  /// Status 200 for a request of the server's own page that changes something, else the refusal.
  Reply check_own(const Request& request);
  std::string cookie_name() const;

  std::unique_ptr<Entrance> entrance_;
  OwnNames names_;
  std::uint16_t port_;
  ShelfHost* shelf_;
  /// Of messages and files of the home page.
  RateLimit shelf_rate_{{.per_s = 20.0, .burst = 60.0, .most_drops = 0}};
};

/// Security headers of every response: what the page may load, and that nothing is cached.
struct Header {
  const char* name;
  const char* value;
};
constexpr std::string_view kContentPolicy =
    "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; object-src 'none'";
/// Of the worker that finds faces, which alone may compile WebAssembly: a worker has the policy of its own
/// script.
constexpr std::string_view kFaceWorkerPath = "/assets/face_worker-";
constexpr std::string_view kFaceWorkerPermissions = "; script-src 'self' 'wasm-unsafe-eval'";
constexpr Header kSafetyHeaders[] = {
    {"X-Content-Type-Options", "nosniff"},
    {"Cache-Control", "no-store"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
};

}  // namespace palpable::page
