// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/sharing.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/page/access.hpp"
#include "palpable/page/share/certificate.hpp"
#include "palpable/page/share/qr_code.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::page {

Result<std::unique_ptr<Sharing>> Sharing::open(Options options) {
  if (options.addresses.empty()) {
    auto found = addresses_in_network();
    if (!found) return found.error();
    options.addresses = *std::move(found);
  }
  auto networks = network_addresses();
  for (std::string& text : options.addresses) {
    const auto address = ip_address(text);
    if (!address) return address.error();
    if (std::none_of(networks.begin(), networks.end(),
                     [&](const NetworkAddress& own) { return own.address == *address; }))
      return invalid_input("is no address of this computer", text);
    text = address->to_string();
  }
  auto certificate = make_certificate(options.addresses);
  if (!certificate) return certificate.error();
  return std::unique_ptr<Sharing>(
      new Sharing(std::move(options), std::move(networks), *std::move(certificate)));
}

bool Sharing::is_local(std::string_view peer) const {
  const auto address = ip_address(peer);
  return address && page::is_local(*address, networks_);
}

void Sharing::begin(std::uint16_t port, std::size_t served, std::int64_t first_probe,
                    std::int64_t last_probe) {
  options_.port = port;
  options_.addresses.resize(std::min(served, options_.addresses.size()));
  guests_.set_probes(first_probe, last_probe);
  const Role first = first_probe <= last_probe ? Role::touch : Role::look;
  if (const auto made = invite(first); !made) say(made.error().message);
}

std::string Sharing::where(std::size_t k) const {
  return "https://" + host_and_port(options_.addresses[k], options_.port) + "/";
}

void Sharing::update() {
  const double now_s = options_.now_s();
  if (invitations_.expire(now_s)) {
    link_.reset();
    ++revision_;
    say(describe::tr("The link has expired. The page makes a new one."));
  }
  guests_.update(now_s);
  while (auto news = guests_.next_news()) say(*std::move(news));
}

void Sharing::say(std::string sentence) {
  if (options_.on_news) options_.on_news(sentence);
  news_.push_back(std::move(sentence));
}

std::optional<std::string> Sharing::next_news() {
  if (news_.empty()) return std::nullopt;
  auto news = std::move(news_.front());
  news_.pop_front();
  return news;
}

bool Sharing::offers(std::string_view token) const { return invitations_.offers(token, options_.now_s()); }

Result<std::string> Sharing::join(std::string_view token, std::string_view agent) {
  const double now_s = options_.now_s();
  // A link that cannot be used now is not used up.
  if (link_ && invitations_.offers(token, now_s))
    if (const auto room = guests_.check_room(*role_named(link_->role), now_s); !room) return room.error();
  const auto role = invitations_.use(token, now_s);
  if (!role) return role.error();
  link_.reset();
  ++revision_;
  return guests_.add(*role, agent, now_s);
}

Result<void> Sharing::invite(Role role) {
  const double now_s = options_.now_s();
  if (const auto room = guests_.check_room(role, now_s); !room) return room.error();
  const auto token = invitations_.open(role, now_s);
  if (!token) return token.error();
  const std::string link = where() + "#" + *token;
  const auto code = qr_code(link);
  if (!code) return code.error();
  const auto minutes = static_cast<std::int64_t>(std::lround(options_.link_lifetime_s / 60.0));
  link_ = protocol::Invitation{std::string(name_of(role)), link, minutes, code->side, code->modules, {}};
  if (options_.addresses.size() > 1) link_->other_link = where(1) + "#" + *token;
  ++revision_;
  if (options_.on_link) options_.on_link(*link_, terminal_text(*code));
  return {};
}

void Sharing::withdraw() {
  if (!invitations_.is_open()) return;
  invitations_.withdraw();
  link_.reset();
  ++revision_;
  say(describe::tr("The link was withdrawn."));
}

void Sharing::show_out(std::int64_t guest) {
  const auto all = guests_.list();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const protocol::Guest& one) { return one.guest == guest; });
  if (found == all.end()) return;
  guests_.remove(guest);
  say(describe::phrase("{} was shown out.", spoken_name(found->name)));
}

protocol::Sharing Sharing::sharing() const {
  return {where(), certificate_.fingerprint, static_cast<std::int64_t>(guests_.places()), link_,
          guests_.list()};
}

}  // namespace palpable::page
