// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page {

/// Look: sees and hears. Touch: also moves a probe of its own.
enum class Role { look, touch };

/// Whether a guest's page is there. Away: not connected, but it may come back.
enum class Presence { coming, here, asleep, away };

/// A person at another device, with whom the touch is shared.
struct Guest {
  /// Counts from 1; never used twice.
  std::int64_t number = 0;
  /// "Phone 1".
  std::string name;
  Role role = Role::look;
  /// The only probe that a touching guest moves; nullopt for those who look.
  std::optional<std::int64_t> probe;
};

/// A self-signed certificate with its private key, both as PEM.
struct ServerCertificate {
  std::string certificate;
  std::string key;
  /// SHA-256 of the certificate (DER) as pairs of hexadecimal digits, separated by colons.
  std::string fingerprint;
};

/// The interface between the page's server and the sharing of a touch with guests in the local network. All
/// calls come from the thread that runs serve(); none may block.
class ShareHost {
 public:
  ShareHost() = default;
  ShareHost(const ShareHost&) = delete;
  ShareHost& operator=(const ShareHost&) = delete;
  virtual ~ShareHost() = default;

  /// The IP addresses at which the server listens for guests, and the port; 0 = any free one. The first
  /// address is needed, further ones may fail.
  virtual const std::vector<std::string>& addresses() const = 0;
  virtual std::uint16_t port() const = 0;
  virtual const ServerCertificate& certificate() const = 0;
  /// Whether a device of this IP address may connect at all.
  virtual bool is_local(std::string_view peer) const = 0;
  /// Called once, when guests can connect at this port of the first `served` addresses. The probes
  /// first…last are free for guests.
  virtual void begin(std::uint16_t port, std::size_t served, std::int64_t first_probe,
                     std::int64_t last_probe) = 0;
  /// Called 20 to 60 times per second.
  virtual void update() = 0;

  /// Whether this is the token of the open link.
  virtual bool offers(std::string_view token) const = 0;
  /// Exchanges a link's token for a new guest's secret, once. `agent`: the browser's own description, which
  /// is not trusted. Errors: a sentence for the guest.
  virtual Result<std::string> join(std::string_view token, std::string_view agent) = 0;
  /// The guest with this secret; null if there is none. Valid until the next call.
  virtual const Guest* guest_of(std::string_view secret) const = 0;
  /// Whether the guest may open a page now: not too often.
  virtual bool may_open(std::int64_t guest) = 0;
  virtual void set_presence(std::int64_t guest, Presence presence) = 0;

  /// Makes a link, which replaces the open one. Errors: a sentence for the host.
  virtual Result<void> invite(Role role) = 0;
  virtual void withdraw() = 0;
  /// Ends a guest's access; its page must then be closed. Nothing happens if there is no such guest.
  virtual void show_out(std::int64_t guest) = 0;

  /// What the host's pages show; `revision` rises with each change of it.
  virtual protocol::Sharing sharing() const = 0;
  virtual std::uint64_t revision() const = 0;
  /// The next sentence for the host about the guests, each once.
  virtual std::optional<std::string> next_news() = 0;
};

/// A guest as messages describe it.
protocol::Guest described(const Guest& guest, Presence presence);
/// "touch", "look"; nullopt for any other word.
std::string_view name_of(Role role);
std::optional<Role> role_named(std::string_view name);

}  // namespace palpable::page
