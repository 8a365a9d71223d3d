// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/client.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/host_changes.hpp"
#include "palpable/page/protocol.hpp"
#include "palpable/page/server.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/beast/core/tcp_stream.hpp>

namespace palpable::page {

/// The open pages of a touch: passes their messages to the host, and the host's changes to them. Everything
/// runs on the server's thread.
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
  /// Why another page cannot be added now; empty if it can.
  std::string obstacle() const;
  void add_client(boost::beast::tcp_stream stream, const Client::Upgrade& upgrade);
  /// Sends what has changed to all pages.
  void update();
  /// Whether nothing has changed and no page has sent anything for a second.
  bool is_at_rest() const;
  void close_all();

 private:
  void note_activity();
  void greet(Client& client);
  void pass(Client& client, const protocol::FromPage& message);
  void send_state();
  void release_probes(const Client& client);
  template <class Do>
  void for_each_client(Do act);
  void broadcast(const SharedFrame& frame);
  void handle(Client& client, const protocol::Pointer& pointer);
  void handle(Client& client, const protocol::Lift& probe);
  void handle(Client&, const protocol::Change& change) { host_->change(change); }
  void handle(Client&, const protocol::Edit& edit) { host_->edit(edit); }
  void handle(Client&, const protocol::Save&) { host_->save(); }
  void handle(Client&, const protocol::Pause& pause) { host_->pause(pause.paused); }
  void handle(Client&, const protocol::Recentre&) { host_->recentre(); }
  void handle(Client&, const protocol::MoveExplorer& pose) { host_->move_explorer(pose); }
  void handle(Client& client, const protocol::Ask& ask);
  void handle(Client& client, const protocol::LookAround& question);
  void handle(Client&, const protocol::Name& name) { host_->name(name); }
  void handle(Client&, const protocol::Unname& name) { host_->unname(name); }
  void handle(Client&, const protocol::UndoName& undo) { host_->undo_name(undo); }
  void handle(Client&, const protocol::Find& find) { host_->find(find); }
  void handle(Client& client, const protocol::Visible& visible);

  std::shared_ptr<PageHost> host_;
  const ServeOptions& options_;
  std::function<void()> on_activity_;
  /// Weak: a client lives as long as operations on its socket are pending, and never longer than the I/O
  /// context.
  std::vector<std::weak_ptr<Client>> clients_;
  /// Set if there is a host.
  std::optional<HostChanges> changes_;
  std::vector<protocol::ProbeState> sent_probes_;
  std::chrono::steady_clock::time_point sent_state_at_;
  std::chrono::steady_clock::time_point active_at_;
  std::int64_t next_page_ = 1;
  /// The page that last moved each probe.
  std::array<std::optional<std::int64_t>, protocol::kMostProbes> movers_;
};

}  // namespace palpable::page
