// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/pages.hpp"

#include "palpable/page/page_state.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace palpable::page {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr auto kRestPeriod = std::chrono::seconds(1);
// The page knows this reason (web/src/home/connection.ts).
constexpr const char* kReplaced = "another scene was opened";

}  // namespace

std::string Pages::obstacle() const {
  if (host_ == nullptr) return "No scene is being touched now: one is being opened, or waits to be chosen.";
  if (clients_.size() < options_.most_clients) return {};
  return "This session is open in " + std::to_string(options_.most_clients) +
         " pages already, which is the limit: close one of them.";
}

void Pages::add_client(boost::beast::tcp_stream stream, const Client::Upgrade& upgrade) {
  Client::Events events;
  events.opened = [this](Client& client) { greet(client); };
  events.message = [this](Client& client, const protocol::FromPage& message) { pass(client, message); };
  events.closed = [this](Client& client) {
    release_probes(client);
    std::erase_if(clients_,
                  [&](const auto& other) { return other.expired() || other.lock().get() == &client; });
  };
  auto client = std::make_shared<Client>(std::move(stream), options_, std::move(events));
  client->page = next_page_++;
  clients_.push_back(client);
  client->accept(upgrade);
}

void Pages::greet(Client& client) {
  if (!changes_) return client.close(boost::beast::websocket::close_code::try_again_later, kReplaced);
  for (const auto& frame : changes_->everything(client.page)) client.send(frame);
  note_activity();
}

void Pages::pass(Client& client, const protocol::FromPage& message) {
  if (host_ == nullptr) return;
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
  sent_probes_.clear();
  changes_.reset();
  host_ = std::move(host);
  if (host_ != nullptr) changes_.emplace(*host_);
  note_activity();
}

void Pages::update() {
  if (host_ == nullptr) return;
  for (const auto& frame : changes_->notices()) broadcast(frame);
  if (clients_.empty()) return;
  host_->update();
  for (const auto& frame : changes_->changes()) broadcast(frame);
  send_state();
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
  const bool moved = !std::equal(state.probes.begin(), state.probes.end(), sent_probes_.begin(),
                                 sent_probes_.end(), nearly_equal);
  if (moved) active_at_ = now;
  const bool is_due = moved || now - sent_state_at_ >= kRestPeriod;
  SharedFrame frame;
  for_each_client([&](Client& client) {
    if (!client.visible || !(is_due || client.is_behind)) return;
    if (frame == nullptr) frame = text_frame(state);
    client.is_behind = !client.send_if_idle(frame);
  });
  if (!is_due) return;
  sent_probes_ = std::move(state.probes);
  sent_state_at_ = now;
}

// Removes the additional probes that this page moved; the first probe stays.
void Pages::release_probes(const Client& client) {
  for (std::size_t probe = 1; probe < client.moved.size(); ++probe)
    if (client.moved.test(probe)) host_->lift({static_cast<std::int64_t>(probe)});
  for (auto& mover : movers_)
    if (mover == client.page) mover.reset();
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

void Pages::handle(Client& client, const protocol::Ask& ask) { client.send(text_frame(host_->answer(ask))); }

void Pages::handle(Client& client, const protocol::LookAround& question) {
  client.send(text_frame(host_->around(question)));
}

void Pages::handle(Client& client, const protocol::Visible& visible) {
  client.visible = visible.visible;
  client.is_behind = true;
}

}  // namespace palpable::page
