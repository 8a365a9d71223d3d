// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/channel.hpp"
#include "palpable/page/client.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/host_changes.hpp"
#include "palpable/page/protocol.hpp"
#include "palpable/page/server.hpp"
#include "palpable/page/share_host.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::page {

/// The open pages of a touch, those of this machine and those of guests: passes their messages to the host,
/// and the host's changes to them. Everything runs on the server's thread.
class Pages {
 public:
  /// `options` outlive this. `on_activity` is called when a page is opened or has sent something.
  Pages(const ServeOptions& options, std::function<void()> on_activity)
      : options_(options), on_activity_(std::move(on_activity)) {}
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  /// The touch that pages show from now on; null: none. The pages of another one are disconnected with the
  /// reason kReplaced; they may connect again.
  void show(std::shared_ptr<PageHost> host);
  /// Why another page of this machine cannot be added now; empty if it can.
  std::string obstacle() const;
  /// A guest's page takes the place of the one that the guest has.
  void add_client(Channel stream, const Client::Upgrade& upgrade, const std::optional<Guest>& guest);
  /// Sends what has changed to all pages.
  void update();
  /// Whether nothing has changed and no page has sent anything for a second.
  bool is_at_rest() const;
  void close_all();

 private:
  void note_activity();
  void greet(Client& client);
  void close_page_of(std::int64_t guest, const char* reason);
  void on_closed(Client& client);
  /// Whether a guest may send this message now; answers it if not.
  bool admits(Client& client, const protocol::FromPage& message);
  void send_notice(const protocol::Notice& notice);
  void send_sharing();
  void pass(Client& client, const protocol::FromPage& message);
  void send_state();
  void send_robot_floor();
  bool tell_who_follows();
  void send_head();
  void release_probes(const Client& client);
  void let_go(const Client& client);
  template <class Do>
  void for_each_client(Do act);
  void broadcast(const SharedFrame& frame);
  /// To the pages of this machine.
  void broadcast_here(const SharedFrame& frame);
  bool is_of_a_guest(std::optional<std::int64_t> probe) const;
  void handle(Client& client, const protocol::Pointer& pointer);
  void handle(Client& client, const protocol::Lift& probe);
  void handle(Client&, const protocol::Change& change) { host_->change(change); }
  void handle(Client&, const protocol::Edit& edit) { host_->edit(edit); }
  void handle(Client&, const protocol::Save&) { host_->save(); }
  void handle(Client&, const protocol::Pause& pause) { host_->pause(pause.paused); }
  void handle(Client&, const protocol::Recentre&) { host_->recentre(); }
  void handle(Client& client, const protocol::RobotOrder& order);
  void handle(Client&, const protocol::MoveExplorer& pose) { host_->move_explorer(pose); }
  void handle(Client& client, const protocol::FollowHead& follow);
  void handle(Client& client, const protocol::Ask& ask);
  void handle(Client& client, const protocol::LookAround& question);
  void handle(Client&, const protocol::Name& name) { host_->name(name); }
  void handle(Client&, const protocol::Unname& name) { host_->unname(name); }
  void handle(Client&, const protocol::UndoName& undo) { host_->undo_name(undo); }
  void handle(Client&, const protocol::Find& find) { host_->find(find); }
  void handle(Client& client, const protocol::Visible& visible);
  void handle(Client& client, const protocol::Language& language);
  void handle(Client& client, const protocol::Invite& invite);
  void handle(Client& client, const protocol::Withdraw& withdraw);
  void handle(Client& client, const protocol::ShowOut& guest);

  std::shared_ptr<PageHost> host_;
  const ServeOptions& options_;
  std::function<void()> on_activity_;
  /// Weak: a client lives as long as operations on its socket are pending, and never longer than the I/O
  /// context.
  std::vector<std::weak_ptr<Client>> clients_;
  /// Set if there is a host.
  std::optional<HostChanges> changes_;
  protocol::State sent_state_;
  std::chrono::steady_clock::time_point sent_state_at_;
  std::optional<protocol::RobotFloor> sent_floor_;
  std::chrono::steady_clock::time_point floor_at_;
  /// As the host was told last.
  protocol::FollowHead follow_;
  std::chrono::steady_clock::time_point active_at_;
  std::int64_t next_page_ = 1;
  std::uint64_t sent_sharing_ = 0;
  /// Of what is said to all: that of the page of this machine that told its own last.
  describe::Language language_ = describe::Language::english;
  /// The page that last moved each probe.
  std::array<std::optional<std::int64_t>, protocol::kMostProbes> movers_;
};

}  // namespace palpable::page
