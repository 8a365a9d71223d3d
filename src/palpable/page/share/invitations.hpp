// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/share_host.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page {

/// One-time links, of which one is open at a time. Times are those of a steady clock in seconds.
class Invitations {
 public:
  explicit Invitations(double lifetime_s) : lifetime_s_(lifetime_s) {}

  /// Opens a link in place of the open one, and returns its token. Errors: the system's random generator
  /// fails.
  Result<std::string> open(Role role, double now_s);
  void withdraw();
  /// Closes the open link if its time is over; returns whether it did.
  bool expire(double now_s);
  bool is_open() const { return open_.has_value(); }

  /// Whether this is the token of the open link.
  bool offers(std::string_view token, double now_s) const;
  /// Uses the open link up. Errors: sentences for the person who has another one, which say what became of
  /// it.
  Result<Role> use(std::string_view token, double now_s);

 private:
  enum class Fate { used, expired, withdrawn };
  struct Open {
    std::string token;
    Role role = Role::look;
    double until_s = 0.0;
  };
  struct Past {
    std::string token;
    Fate fate = Fate::used;
  };
  void close(Fate fate);

  double lifetime_s_;
  std::optional<Open> open_;
  /// The newest last; so many that their holders are told what became of them.
  std::vector<Past> past_;
};

}  // namespace palpable::page
