// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/pages.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/page/page_state.hpp"
#include "palpable/page/roles.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace palpable::page {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr auto kRestPeriod = std::chrono::seconds(1);
// The page knows these reasons (web/src/home/connection.ts).
constexpr const char* kReplaced = "another scene was opened";
constexpr const char* kOtherTab = "opened in another tab";
constexpr const char* kShownOut = "shown out";

}  // namespace

std::string Pages::obstacle() const {
  if (host_ == nullptr) return "No scene is being touched now: one is being opened, or waits to be chosen.";
  const auto here = std::count_if(clients_.begin(), clients_.end(), [](const auto& weak) {
    const auto client = weak.lock();
    return client != nullptr && !client->guest;
  });
  if (static_cast<std::size_t>(here) < options_.most_clients) return {};
  return "This session is open in " + std::to_string(options_.most_clients) +
         " pages already, which is the limit: close one of them.";
}

void Pages::add_client(Channel stream, const Client::Upgrade& upgrade, const std::optional<Guest>& guest) {
  if (guest) close_page_of(guest->number, kOtherTab);
  Client::Events events;
  events.opened = [this](Client& client) { greet(client); };
  events.message = [this](Client& client, const protocol::FromPage& message) { pass(client, message); };
  events.closed = [this](Client& client) { on_closed(client); };
  auto client = std::make_shared<Client>(std::move(stream), options_, std::move(events));
  client->page = next_page_++;
  client->guest = guest;
  clients_.push_back(client);
  client->accept(upgrade);
}

void Pages::greet(Client& client) {
  if (!changes_) return client.close(boost::beast::websocket::close_code::try_again_later, kReplaced);
  std::optional<protocol::Guest> guest;
  if (client.guest) guest = described(*client.guest, Presence::here);
  for (const auto& frame : changes_->everything(client.page, guest)) client.send(frame);
  if (guest) {
    options_.share->set_presence(guest->guest, Presence::here);
  } else if (options_.share != nullptr) {
    client.send(text_frame(options_.share->sharing()));
  }
  sent_floor_.reset();
  note_activity();
}

void Pages::close_page_of(std::int64_t guest, const char* reason) {
  for_each_client([&](Client& client) {
    if (!client.guest || client.guest->number != guest) return;
    // At once, since the guest's next page may move the same probe before this one is closed.
    release_probes(client);
    client.moved.reset();
    client.close(boost::beast::websocket::close_code::policy_error, reason);
  });
}

void Pages::on_closed(Client& client) {
  let_go(client);
  release_probes(client);
  std::erase_if(clients_,
                [&](const auto& other) { return other.expired() || other.lock().get() == &client; });
  if (host_ != nullptr) tell_who_follows();
  const auto is_same_guest = [&](const auto& other) {
    const auto page = other.lock();
    return page != nullptr && page->guest && page->guest->number == client.guest->number;
  };
  if (client.guest && std::none_of(clients_.begin(), clients_.end(), is_same_guest))
    options_.share->set_presence(client.guest->number, Presence::away);
}

bool Pages::admits(Client& client, const protocol::FromPage& message) {
  const Ruling what = ruling(*client.guest, message);
  if (what == Ruling::pass) return true;
  switch (client.questions.check(seconds_now())) {
    case Verdict::accept:
      break;
    case Verdict::drop:
      return false;
    case Verdict::disconnect:
      client.close(boost::beast::websocket::close_code::policy_error, "too many questions");
      return false;
  }
  if (what == Ruling::question) return true;
  client.send(text_frame(
      protocol::Notice{"answer", describe::tr("Only the person who shares the scene can do that."), {}}));
  return false;
}

void Pages::pass(Client& client, const protocol::FromPage& message) {
  if (host_ == nullptr) return;
  const describe::LanguageScope scope(client.language);
  if (client.guest && !admits(client, message)) return;
  std::visit([&](const auto& m) { handle(client, m); }, message);
  note_activity();
}

void Pages::show(std::shared_ptr<PageHost> host) {
  if (host == host_) return;
  for_each_client([](Client& client) {
    client.moved.reset();
    client.close(boost::beast::websocket::close_code::try_again_later, kReplaced);
  });
  movers_ = {};
  sent_state_ = {};
  sent_floor_.reset();
  follow_ = {};
  changes_.reset();
  host_ = std::move(host);
  if (host_ != nullptr) changes_.emplace(*host_);
  note_activity();
}

void Pages::update() {
  if (host_ == nullptr) return;
  const describe::LanguageScope scope(language_);
  for (const auto& notice : changes_->notices()) send_notice(notice);
  if (options_.share != nullptr) send_sharing();
  if (clients_.empty()) return;
  host_->update();
  for (const auto& frame : changes_->changes()) broadcast(frame);
  send_state();
  send_robot_floor();
  send_head();
}

void Pages::send_notice(const protocol::Notice& notice) {
  const auto frame = text_frame(notice);
  const bool is_of_guest = is_of_a_guest(notice.probe);
  for_each_client([&](Client& client) {
    if (client.guest ? concerns(*client.guest, notice, is_of_guest) : !is_of_guest) client.send(frame);
  });
}

// Who is there is shown, and said.
void Pages::send_sharing() {
  while (auto news = options_.share->next_news())
    broadcast_here(text_frame(protocol::Notice{"info", *std::move(news), {}}));
  if (options_.share->revision() == sent_sharing_) return;
  sent_sharing_ = options_.share->revision();
  broadcast_here(text_frame(options_.share->sharing()));
}

bool Pages::is_of_a_guest(std::optional<std::int64_t> probe) const {
  return probe && std::any_of(clients_.begin(), clients_.end(), [&](const auto& weak) {
           const auto client = weak.lock();
           return client != nullptr && client->guest && client->guest->probe == probe;
         });
}

bool Pages::is_at_rest() const { return steady_clock::now() - active_at_ >= kRestPeriod; }

void Pages::close_all() {
  for_each_client([](Client& client) {
    client.close(boost::beast::websocket::close_code::going_away, "the session has ended");
  });
}

void Pages::note_activity() {
  active_at_ = steady_clock::now();
  on_activity_();
}

// Once per second at rest; otherwise each time, to the pages that keep up.
void Pages::send_state() {
  protocol::State state = host_->state();
  for (auto& probe : state.probes) probe.page = movers_.at(static_cast<std::size_t>(probe.probe));
  const auto now = steady_clock::now();
  const bool moved = !nearly_equal(state, sent_state_);
  if (moved) active_at_ = now;
  const bool is_due = moved || now - sent_state_at_ >= kRestPeriod;
  SharedFrame frame;
  for_each_client([&](Client& client) {
    if (!client.visible || !(is_due || client.is_behind)) return;
    if (frame == nullptr) frame = text_frame(state);
    client.is_behind = !client.send_if_idle(frame);
  });
  if (!is_due) return;
  sent_state_ = std::move(state);
  sent_state_at_ = now;
}

// Twice a second at most, and only where somebody looks.
void Pages::send_robot_floor() {
  constexpr auto kPeriod = milliseconds(500);
  const auto now = steady_clock::now();
  if (now - floor_at_ < kPeriod) return;
  auto floor = host_->robot_floor();
  if (!floor || floor == sent_floor_) return;
  floor_at_ = now;
  const auto frame = text_frame(*floor);
  sent_floor_ = std::move(floor);
  for_each_client([&](Client& client) {
    if (client.visible) client.send(frame);
  });
}

/// Whether a page follows the viewer's head; the host is told when that changes.
bool Pages::tell_who_follows() {
  const auto follows = [](const auto& weak) {
    const auto client = weak.lock();
    return client != nullptr && client->visible && client->follows_head;
  };
  const bool is_followed = std::any_of(clients_.begin(), clients_.end(), follows);
  if (is_followed != follow_.follows) {
    follow_.follows = is_followed;
    host_->follow_head(follow_);
  }
  return is_followed;
}

// At once, since the view follows it: a page that does is not at rest.
void Pages::send_head() {
  if (!tell_who_follows()) return;
  active_at_ = steady_clock::now();
  const auto head = host_->head();
  if (!head) return;
  const auto frame = text_frame(*head);
  // A place is replaced by the next one; that none will come is not.
  const bool is_replaced = head->pictures == "come";
  for_each_client([&](Client& client) {
    if (!client.visible || !client.follows_head) return;
    if (is_replaced)
      static_cast<void>(client.send_if_idle(frame));
    else
      client.send(frame);
  });
}

// Removes the additional probes that this page moved; the first probe stays.
void Pages::release_probes(const Client& client) {
  for (std::size_t probe = 1; probe < client.moved.size(); ++probe)
    if (client.moved.test(probe)) host_->lift({static_cast<std::int64_t>(probe)});
  for (auto& mover : movers_)
    if (mover == client.page) mover.reset();
}

// Nobody sees what the first probe drives, or could stop it.
void Pages::let_go(const Client& client) {
  if (host_ != nullptr && movers_.front() == client.page) host_->let_go();
}

// Iterates over a copy, since a disconnected client is removed from the list.
template <class Do>
void Pages::for_each_client(Do act) {
  const auto clients = clients_;
  for (const auto& weak : clients)
    if (const auto client = weak.lock()) act(*client);
}

void Pages::broadcast(const SharedFrame& frame) {
  for_each_client([&](Client& client) { client.send(frame); });
}

void Pages::broadcast_here(const SharedFrame& frame) {
  for_each_client([&](Client& client) {
    if (!client.guest) client.send(frame);
  });
}

void Pages::handle(Client& client, const protocol::Pointer& pointer) {
  const auto probe = static_cast<std::size_t>(pointer.probe);
  client.moved.set(probe);
  if (probe > 0 || host_->hello().pointer_moves) movers_.at(probe) = client.page;
  host_->move(pointer);
}

void Pages::handle(Client& client, const protocol::Lift& probe) {
  client.moved.reset(static_cast<std::size_t>(probe.probe));
  movers_.at(static_cast<std::size_t>(probe.probe)).reset();
  host_->lift(probe);
}

void Pages::handle(Client& client, const protocol::RobotOrder& order) {
  // Who starts it has to see it, before the first movement of the probe, too.
  if (order.word == "start" && host_->hello().pointer_moves) movers_.front() = client.page;
  host_->order(order);
}

void Pages::handle(Client& client, const protocol::FollowHead& follow) {
  client.follows_head = follow.follows;
  if (!follow.follows) return;
  follow_ = follow;
  host_->follow_head(follow_);
}

void Pages::handle(Client& client, const protocol::Ask& ask) {
  // The last probe is no guest's (server.cpp).
  const auto asked = client.guest ? asked_by(*client.guest, ask, host_->hello().probes - 1) : ask;
  client.send(text_frame(host_->answer(asked)));
}

void Pages::handle(Client& client, const protocol::LookAround& question) {
  client.send(text_frame(host_->around(question)));
}

void Pages::handle(Client& client, const protocol::Visible& visible) {
  client.visible = visible.visible;
  client.is_behind = true;
  if (!visible.visible) let_go(client);
  sent_floor_.reset();
  if (!client.guest) return;
  // A phone that sleeps, or shows something else, leaves no probe on the surface.
  if (!visible.visible) {
    release_probes(client);
    client.moved.reset();
  }
  options_.share->set_presence(client.guest->number, visible.visible ? Presence::here : Presence::asleep);
}

void Pages::handle(Client& client, const protocol::Language& language) {
  const auto known = describe::language_from(language.language);
  if (!known) return;
  client.language = *known;
  if (!client.guest) language_ = *known;
}

void Pages::handle(Client& client, const protocol::Invite& invite) {
  const auto role = role_named(invite.role);
  if (options_.share == nullptr || !role) return;
  if (const auto made = options_.share->invite(*role); !made)
    client.send(text_frame(protocol::Notice{"answer", made.error().message, {}}));
}

void Pages::handle(Client&, const protocol::Withdraw&) {
  if (options_.share != nullptr) options_.share->withdraw();
}

void Pages::handle(Client&, const protocol::ShowOut& guest) {
  if (options_.share == nullptr) return;
  close_page_of(guest.guest, kShownOut);
  options_.share->show_out(guest.guest);
}

}  // namespace palpable::page
