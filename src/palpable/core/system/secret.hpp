// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace palpable {

/// 128 bits from the operating system's random generator as 32 hexadecimal digits. Errors: the generator
/// fails.
Result<std::string> random_secret();

/// Compares in constant time, independent of how many characters agree.
bool same_secret(std::string_view a, std::string_view b);

/// Exchanges the token of a printed address, once, for the session's secret.
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

}  // namespace palpable
