// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/rate_limit.hpp"
#include "palpable/page/share_host.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page {

/// Who takes part in a shared touch. Times are those of a steady clock in seconds.
class Guests {
 public:
  /// At most so many at once.
  explicit Guests(std::size_t places) : places_(places) {}

  /// The probes first…last are for guests who touch.
  void set_probes(std::int64_t first, std::int64_t last);

  /// Whether a guest of this role can be added now. If all places are taken, the one that has been away
  /// longest gives its own, if it has been away for 30 seconds. Errors: sentences for the guest.
  Result<void> check_room(Role role, double now_s) const;
  /// Adds a guest, and returns its secret. `agent`: a browser's description of itself. Errors: those of
  /// check_room(); the system's random generator fails.
  Result<std::string> add(Role role, std::string_view agent, double now_s);
  void remove(std::int64_t number);

  const Guest* with_secret(std::string_view secret) const;
  /// Whether the guest may open a page now: 20 at once, two per second on average.
  bool may_open(std::int64_t number, double now_s);
  void set_presence(std::int64_t number, Presence presence, double now_s);
  /// Notes the news of those whose presence has not changed for two seconds: phones reload pages, and change
  /// between networks.
  void update(double now_s);

  std::vector<protocol::Guest> list() const;
  std::size_t places() const { return places_; }
  /// Rises with each change of the list.
  std::uint64_t revision() const { return revision_; }
  std::optional<std::string> next_news();

 private:
  struct Entry {
    Guest guest;
    std::string secret;
    Presence presence = Presence::coming;
    /// What the host was told of it.
    Presence told = Presence::coming;
    /// Whether the host was told that it is coming.
    bool awaited = false;
    double since_s = 0.0;
    RateLimit pages{{.per_s = 2.0, .burst = 20.0, .most_drops = 0}};
  };
  Entry* find(std::int64_t number);
  std::optional<std::int64_t> free_probe(const Entry* besides) const;
  /// Who would give its place to a new guest; null if nobody need, or nobody can.
  const Entry* leaving(double now_s) const;
  void say(const Entry& entry);

  std::size_t places_;
  std::int64_t first_probe_ = 1;
  std::int64_t last_probe_ = 0;
  std::int64_t next_number_ = 1;
  std::vector<Entry> entries_;
  std::uint64_t revision_ = 0;
  std::deque<std::string> news_;
};

/// A guest's name "Phone 1" as it is said: its kind in the current language.
std::string spoken_name(const std::string& name);

}  // namespace palpable::page
