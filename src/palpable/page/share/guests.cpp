// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/guests.hpp"

#include "palpable/core/system/secret.hpp"
#include "palpable/describe/language.hpp"

#include <algorithm>
#include <utility>

namespace palpable::page {
namespace {

constexpr double kAwayBeforeLeaving_s = 30.0;
constexpr double kSettled_s = 2.0;

/// What a browser says of its device; one that says nothing known, or pretends, is a computer.
std::string_view kind_of(std::string_view agent) {
  const auto has = [&](std::string_view word) { return agent.find(word) != std::string_view::npos; };
  if (has("iPad") || has("Tablet") || (has("Android") && !has("Mobile"))) return "Tablet";
  return has("Mobile") || has("iPhone") ? "Phone" : "Computer";
}

bool is_gone(Presence presence) { return presence == Presence::away || presence == Presence::coming; }

}  // namespace

std::string spoken_name(const std::string& name) {
  const auto blank = name.find(' ');
  return describe::known(name.substr(0, blank)) + name.substr(std::min(blank, name.size()));
}

void Guests::set_probes(std::int64_t first, std::int64_t last) {
  first_probe_ = first;
  last_probe_ = last;
}

const Guests::Entry* Guests::leaving(double now_s) const {
  if (entries_.size() < places_) return nullptr;
  const Entry* longest = nullptr;
  for (const Entry& one : entries_) {
    if (!is_gone(one.presence) || now_s - one.since_s < kAwayBeforeLeaving_s) continue;
    if (longest == nullptr || one.since_s < longest->since_s) longest = &one;
  }
  return longest;
}

// From the highest one down: the pages of this machine take the lowest ones for their fingers.
std::optional<std::int64_t> Guests::free_probe(const Entry* besides) const {
  for (std::int64_t probe = last_probe_; probe >= first_probe_; --probe)
    if (std::none_of(entries_.begin(), entries_.end(),
                     [&](const Entry& one) { return &one != besides && one.guest.probe == probe; }))
      return probe;
  return std::nullopt;
}

Result<void> Guests::check_room(Role role, double now_s) const {
  const Entry* gives = leaving(now_s);
  if (entries_.size() >= places_ && gives == nullptr)
    return invalid_input(describe::phrase(
        "There are {} guests already, which is the limit. Try again when one has left.", places_));
  if (role == Role::touch && !free_probe(gives))
    return invalid_input(describe::tr("Every probe is in use already. Ask for a link to look."));
  return {};
}

Result<std::string> Guests::add(Role role, std::string_view agent, double now_s) {
  if (const auto room = check_room(role, now_s); !room) return room.error();
  auto secret = random_secret();
  if (!secret) return secret.error();
  if (const Entry* gives = leaving(now_s)) {
    news_.push_back(describe::phrase("{} was away, and has lost its place.", spoken_name(gives->guest.name)));
    remove(gives->guest.number);
  }
  Entry entry;
  entry.guest.number = next_number_++;
  entry.guest.name = std::string(kind_of(agent)) + " " + std::to_string(entry.guest.number);
  entry.guest.role = role;
  if (role == Role::touch) entry.guest.probe = free_probe(nullptr);
  entry.secret = *secret;
  entry.since_s = now_s;
  entries_.push_back(std::move(entry));
  ++revision_;
  return secret;
}

void Guests::remove(std::int64_t number) {
  revision_ += std::erase_if(entries_, [&](const Entry& one) { return one.guest.number == number; });
}

Guests::Entry* Guests::find(std::int64_t number) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& one) { return one.guest.number == number; });
  return found == entries_.end() ? nullptr : &*found;
}

const Guest* Guests::with_secret(std::string_view secret) const {
  const Guest* found = nullptr;
  for (const Entry& one : entries_)
    if (same_secret(secret, one.secret)) found = &one.guest;
  return found;
}

bool Guests::may_open(std::int64_t number, double now_s) {
  Entry* entry = find(number);
  return entry != nullptr && entry->pages.check(now_s) == Verdict::accept;
}

void Guests::set_presence(std::int64_t number, Presence presence, double now_s) {
  Entry* entry = find(number);
  if (entry == nullptr || entry->presence == presence) return;
  entry->presence = presence;
  entry->since_s = now_s;
  ++revision_;
  if (entry->told == Presence::coming && presence == Presence::here) say(*entry);
}

void Guests::update(double now_s) {
  for (Entry& one : entries_) {
    // The link was used, and no page has come: a warning holds the person up, or the phone sleeps.
    const bool waits = one.presence == Presence::coming && !one.awaited && now_s - one.since_s >= kSettled_s;
    if (waits) news_.push_back(describe::phrase("{} is on the way.", spoken_name(one.guest.name)));
    one.awaited = one.awaited || waits;
    if (one.told != Presence::coming && one.told != one.presence && now_s - one.since_s >= kSettled_s)
      say(one);
  }
}

void Guests::say(const Entry& entry) {
  const Guest& guest = entry.guest;
  const std::string name = spoken_name(guest.name);
  const Presence told = std::exchange(find(guest.number)->told, entry.presence);
  if (told == Presence::coming) {
    news_.push_back(
        guest.probe ? describe::phrase("{} has joined, and touches with probe {}.", name, *guest.probe + 1)
                    : describe::phrase("{} has joined, and looks.", name));
  } else if (entry.presence == Presence::here) {
    news_.push_back(describe::phrase("{} is back.", name));
  } else {
    news_.push_back(describe::phrase(
        entry.presence == Presence::asleep ? "{} sleeps, or shows something else." : "{} is away.", name));
  }
}

std::vector<protocol::Guest> Guests::list() const {
  std::vector<protocol::Guest> all;
  for (const Entry& one : entries_) all.push_back(described(one.guest, one.presence));
  return all;
}

std::optional<std::string> Guests::next_news() {
  if (news_.empty()) return std::nullopt;
  auto news = std::move(news_.front());
  news_.pop_front();
  return news;
}

}  // namespace palpable::page
