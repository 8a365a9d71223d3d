// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace palpable::page {

/// 128 bits of the operating system's randomness as 32 hexadecimal digits. Errors: no randomness to be had.
Result<std::string> random_secret();

/// Compares in a time that does not depend on how much of it is right.
bool same_secret(std::string_view a, std::string_view b);

/// The value of the cookie `name` in a Cookie header's value; empty if it is not there.
std::string_view cookie_value(std::string_view header, std::string_view name);

/// Who may talk to the page's server: loopback by its own name and port only. A Host that is any other name
/// is a page elsewhere whose name was pointed here (DNS rebinding); an Origin that is not ours is a page
/// elsewhere that talks to us from the same browser.
bool is_own_host(std::string_view host, std::uint16_t port);
bool is_own_origin(std::string_view origin, std::uint16_t port);

/// The token of the address that was printed: good for one exchange against the session's secret.
class SessionAccess {
 public:
  SessionAccess(std::string token, std::string secret)
      : token_(std::move(token)), secret_(std::move(secret)) {}

  /// The session's secret for the right token, once; empty for a wrong token or one that was used.
  std::string exchange(std::string_view token);
  bool used() const { return used_; }
  /// Whether this is the session's secret.
  bool admits(std::string_view secret) const { return same_secret(secret, secret_); }

 private:
  std::string token_;
  std::string secret_;
  bool used_ = false;
};

}  // namespace palpable::page
