// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/invitations.hpp"

#include "palpable/core/system/secret.hpp"

#include <cstddef>
#include <utility>

namespace palpable::page {
namespace {

constexpr std::size_t kMostPast = 64;

}  // namespace

Result<std::string> Invitations::open(Role role, double now_s) {
  auto token = random_secret();
  if (!token) return token.error();
  withdraw();
  open_ = Open{*token, role, now_s + lifetime_s_};
  return token;
}

void Invitations::close(Fate fate) {
  if (past_.size() >= kMostPast) past_.erase(past_.begin());
  past_.push_back({std::move(open_->token), fate});
  open_.reset();
}

void Invitations::withdraw() {
  if (open_) close(Fate::withdrawn);
}

bool Invitations::expire(double now_s) {
  if (!open_ || now_s < open_->until_s) return false;
  close(Fate::expired);
  return true;
}

bool Invitations::offers(std::string_view token, double now_s) const {
  return open_ && now_s < open_->until_s && same_secret(token, open_->token);
}

Result<Role> Invitations::use(std::string_view token, double now_s) {
  if (offers(token, now_s)) {
    const Role role = open_->role;
    close(Fate::used);
    return role;
  }
  expire(now_s);
  for (const Past& past : past_) {
    if (!same_secret(token, past.token)) continue;
    if (past.fate == Fate::used)
      return invalid_input(
          "This link was used already: each link lets one device in, once. Ask for a new one.");
    if (past.fate == Fate::expired) return invalid_input("This link has expired. Ask for a new one.");
    return invalid_input("This link was withdrawn. Ask for a new one.");
  }
  return invalid_input("This is no link of this scene. Ask for a new one.");
}

}  // namespace palpable::page
