// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/language.hpp"
#include "palpable/onefile/browser_touch.hpp"
#include "palpable/page/host_changes.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <deque>
#include <string_view>
#include <vector>

namespace palpable::onefile {

/// The messages between a page and its BrowserTouch (web/protocol.json), as page::serve() exchanges them with
/// the pages of a session. One thread.
class PageTalk {
 public:
  /// `touch` must outlive this. The first frames wait already.
  explicit PageTalk(BrowserTouch& touch);

  /// A message of the page; one that is not valid is ignored.
  void receive(std::string_view text);
  /// Runs the touch for this time. False at rest: nothing has changed for a second, and nothing will before
  /// the page's next message.
  bool advance(double seconds);
  /// The next frame for the page; null if none waits.
  page::SharedFrame take();

 private:
  void handle(const page::protocol::Pointer& pointer) { touch_.move(pointer); }
  void handle(const page::protocol::Lift& probe) { touch_.lift(probe); }
  void handle(const page::protocol::Change& change) { touch_.change(change); }
  void handle(const page::protocol::Edit& edit) { touch_.edit(edit); }
  void handle(const page::protocol::Save&) { touch_.save(); }
  void handle(const page::protocol::Pause& pause) { touch_.pause(pause.paused); }
  void handle(const page::protocol::Recentre&) { touch_.recentre(); }
  void handle(const page::protocol::MoveExplorer& pose) { touch_.move_explorer(pose); }
  void handle(const page::protocol::Ask& ask);
  void handle(const page::protocol::LookAround& question);
  void handle(const page::protocol::Name& name) { touch_.name(name); }
  void handle(const page::protocol::Unname& name) { touch_.unname(name); }
  void handle(const page::protocol::UndoName& undo) { touch_.undo_name(undo); }
  void handle(const page::protocol::Find& find) { touch_.find(find); }
  void handle(const page::protocol::Visible&) {}
  void handle(const page::protocol::Language& language);
  // A file is not shared.
  void handle(const page::protocol::Invite&) {}
  void handle(const page::protocol::Withdraw&) {}
  void handle(const page::protocol::ShowOut&) {}
  void handle(const page::protocol::RobotOrder&) {}
  void handle(const page::protocol::FollowHead&) {}
  void send(const std::vector<page::SharedFrame>& frames);

  BrowserTouch& touch_;
  page::HostChanges changes_;
  std::deque<page::SharedFrame> waiting_;
  page::protocol::State sent_;
  /// Time without a change or message.
  double quiet_s_ = 0.0;
  describe::Language language_ = describe::Language::english;
};

}  // namespace palpable::onefile
