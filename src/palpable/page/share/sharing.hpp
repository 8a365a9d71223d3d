// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/rate_limit.hpp"
#include "palpable/page/share/guests.hpp"
#include "palpable/page/share/invitations.hpp"
#include "palpable/page/share/local_network.hpp"
#include "palpable/page/share_host.hpp"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace palpable::page {

/// Shares a touch with guests in the local network: everything but the connections, which are the server's.
/// Used by the thread that serves.
class Sharing final : public ShareHost {
 public:
  struct Options {
    /// The IP addresses of this computer at which guests connect, that of the QR code first; none: those by
    /// which it is reached.
    std::vector<std::string> addresses;
    /// 0 = any free port.
    std::uint16_t port = 0;
    std::size_t places = 8;
    double link_lifetime_s = 600.0;
    /// A steady clock.
    std::function<double()> now_s = seconds_now;
    /// The first link, as soon as guests can connect, and each later one; with its picture for a terminal.
    /// May be empty.
    std::function<void(const protocol::Invitation& link, const std::string& terminal_code)> on_link;
    /// Each sentence about the guests. May be empty.
    std::function<void(const std::string& sentence)> on_news;
  };
  /// Errors: this computer is in no network, or an address is none of its own; OpenSSL fails.
  static Result<std::unique_ptr<Sharing>> open(Options options);

  const std::vector<std::string>& addresses() const override { return options_.addresses; }
  std::uint16_t port() const override { return options_.port; }
  const ServerCertificate& certificate() const override { return certificate_; }
  bool is_local(std::string_view peer) const override;
  void begin(std::uint16_t port, std::size_t served, std::int64_t first_probe,
             std::int64_t last_probe) override;
  void update() override;
  bool offers(std::string_view token) const override;
  Result<std::string> join(std::string_view token, std::string_view agent) override;
  const Guest* guest_of(std::string_view secret) const override { return guests_.with_secret(secret); }
  bool may_open(std::int64_t guest) override { return guests_.may_open(guest, options_.now_s()); }
  void set_presence(std::int64_t guest, Presence presence) override {
    guests_.set_presence(guest, presence, options_.now_s());
  }
  Result<void> invite(Role role) override;
  void withdraw() override;
  void show_out(std::int64_t guest) override;
  protocol::Sharing sharing() const override;
  std::uint64_t revision() const override { return revision_ + guests_.revision(); }
  std::optional<std::string> next_news() override;

 private:
  Sharing(Options options, std::vector<NetworkAddress> networks, ServerCertificate certificate)
      : options_(std::move(options)),
        networks_(std::move(networks)),
        certificate_(std::move(certificate)),
        invitations_(options_.link_lifetime_s),
        guests_(options_.places) {}

  /// The page at the k-th address.
  std::string where(std::size_t k = 0) const;
  void say(std::string sentence);

  Options options_;
  std::vector<NetworkAddress> networks_;
  ServerCertificate certificate_;
  Invitations invitations_;
  Guests guests_;
  /// The open link, as it is shown.
  std::optional<protocol::Invitation> link_;
  std::deque<std::string> news_;
  std::uint64_t revision_ = 1;
};

}  // namespace palpable::page
