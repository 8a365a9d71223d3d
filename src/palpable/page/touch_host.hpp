// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/formats/scene/unsaved_scene.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/page_materials.hpp"
#include "palpable/page/page_robot.hpp"
#include "palpable/page/spoken_words.hpp"
#include "palpable/session/touch/find_pull.hpp"
#include "palpable/session/touch/head_feed.hpp"
#include "palpable/session/touch/outage.hpp"
#include "palpable/session/touch/robot_control.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::page {

/// The page's server's interface to a TouchSession. Long changes (a new law, another height factor) run on a
/// worker thread, so that the page keeps its rate; of several waiting changes, the last one counts.
class TouchHost final : public PageHost {
 public:
  struct Options {
    /// Shown to the user: "palpable 0.1.0".
    std::string program;
    /// The scene's name; empty: its title, or the names of its input files.
    std::string name;
    /// Called once per frame on the server's thread: a finer scene if one is ready, else null. May be empty.
    std::function<std::shared_ptr<const models::Scene>()> take_better_scene;
    /// A finer scene is being made: the opening words say so.
    bool better_follows = false;
    /// Where save() writes the scene (.palp).
    std::filesystem::path save_as;
    /// The device's frame follows an explorer that the page moves.
    bool egocentric = false;
    /// The scene changes many times a second, so the page shows it twice a second, without a word.
    bool live = false;
    /// The server has a home page.
    bool home = false;
    /// The robot whose camera is touched; null: none.
    session::RobotControl* robot = nullptr;
    /// Keeps the scene whenever its names have changed, on a thread of the host; may be empty, or fail: they
    /// are kept beside `save_as` then, until save().
    std::function<Result<void>(const models::Scene&)> keep = {};
    /// Said as the touch begins, in the language of the pages where the catalogue has them.
    std::vector<std::string> notes = {};
    /// Finds the head of who sits before the screen; null: nothing does.
    session::HeadFeed* head = nullptr;
  };
  /// `session`, and what the options refer to, must outlive the host.
  TouchHost(session::TouchSession& session, Options options);
  ~TouchHost() override;

  protocol::Hello hello() const override;
  protocol::Laws laws() const override;
  std::shared_ptr<const PageScene> scene() override;
  protocol::Settings settings() override;
  protocol::Materials materials() override;
  std::optional<protocol::Robot> robot() override;
  std::optional<protocol::RobotFloor> robot_floor() override;
  std::optional<protocol::Head> head() override;
  void follow_head(const protocol::FollowHead& follow) override;
  protocol::State state() override;
  void update() override;
  void move(const protocol::Pointer& pointer) override;
  void lift(const protocol::Lift& probe) override;
  void change(const protocol::Change& change) override;
  void edit(const protocol::Edit& edit) override;
  void save() override;
  void pause(bool paused) override;
  void recentre() override;
  void order(const protocol::RobotOrder& order) override;
  void let_go() override;
  void move_explorer(const protocol::MoveExplorer& pose) override;
  protocol::Words answer(const protocol::Ask& ask) override;
  protocol::Around around(const protocol::LookAround& question) override;
  void name(const protocol::Name& name) override { edit_names(name); }
  void unname(const protocol::Unname& name) override { edit_names(name); }
  void undo_name(const protocol::UndoName& undo) override { edit_names(undo); }
  void find(const protocol::Find& find) override;
  std::optional<protocol::Notice> next_notice() override;

  /// Adds a notice for the user; levels and `probe` as in protocol.json. Any thread.
  void say(std::string level, std::string text, std::optional<std::int64_t> probe = {});

 private:
  /// The waiting tasks, taken all at once. Of several edits of one value, the last one counts.
  struct Tasks {
    std::optional<protocol::Change> change;
    MaterialEdits edits;
    std::shared_ptr<const models::Scene> better;
    bool recentre = false;
    bool save = false;
    /// Names were edited: a copy of the scene is kept until it is saved.
    bool keep = false;
    /// What is said of that, with its level, once the copy is kept.
    std::vector<std::pair<std::string, std::string>> edited_words;
    std::optional<session::ExplorerPose> pose;
    /// A new guide of the hand; null in it: none.
    std::optional<std::shared_ptr<const models::RouteGuide>> guide;
    /// Serial of the last change or edit among them.
    std::int64_t serial = 0;
    bool any() const {
      return change || !edits.empty() || better || recentre || save || keep || pose || guide;
    }
  };
  void work();
  void carry_out(const Tasks& tasks);
  void put(const std::function<void(Tasks&)>& task);
  Result<void> attempt(const protocol::Change& change);
  Result<void> attempt(const MaterialEdits& edits);
  Result<void> swap_in(const models::Scene& better);
  Result<void> write_scene();
  Result<void> keep_names();
  /// The touched scene with the names that pages have edited.
  std::shared_ptr<const models::Scene> named_scene();
  /// Puts the edited names into a scene that has been touched without them.
  models::Scene with_edited_names(models::Scene scene);
  bool has_edited_names();
  template <class Edit>
  void edit_names(const Edit& edit);
  /// Ends the pull where its place has been reached, or where the person pushed the hand away.
  void watch_pull();
  void end_pull();
  Result<void> set_explorer_pose(const session::ExplorerPose& pose);
  /// Carries out `step`; reports its automatic changes, or its error.
  void report(const std::function<Result<void>()>& step);
  void take_notices();
  /// The page's first probe in the middle, above the surface.
  static constexpr protocol::Pointer kAtRest{0, 0.0, 0.0, -0.02};
  bool pointer_moves() const { return !session_.device_traits().pushes_back; }
  void place(const protocol::Pointer& pointer);

  session::TouchSession& session_;
  /// Used by the server's thread alone.
  SpokenWords words_;
  Options options_;

  // Used by the server's thread alone.
  /// The touched scene, and the same with edited names.
  std::shared_ptr<const models::Scene> unnamed_;
  std::shared_ptr<const models::Scene> named_;
  session::FindPull pull_;
  RobotNews robot_news_;
  /// Of each hand's device.
  std::vector<session::Outage> outages_;
  /// The scene's own guide while a pull takes its place.
  std::shared_ptr<const models::RouteGuide> own_guide_;
  std::chrono::steady_clock::time_point watched_;
  std::shared_ptr<const models::Scene> shown_;
  std::chrono::steady_clock::time_point shown_time_;
  std::shared_ptr<const PageScene> page_scene_;
  /// Each probe's place as the pages set it; the first one is above the surface until it is moved.
  std::array<std::optional<protocol::Pointer>, protocol::kMostProbes> pointers_{kAtRest};
  std::chrono::steady_clock::time_point rate_time_;
  double rate_hz_ = 0.0;

  // Guarded by mutex_.
  std::mutex mutex_;
  std::condition_variable wake_;
  Tasks tasks_;
  bool ending_ = false;
  std::deque<protocol::Notice> notices_;
  std::int64_t answered_ = 0;
  /// nullopt until a page has edited them.
  std::optional<models::PlaceNames> edited_names_;

  // Used by the worker alone.
  bool edited_ = false;
  formats::UnsavedScene unsaved_;
  /// Of what is said to all: what the worker says follows the pages' last choice.
  std::atomic<describe::Language> language_ = describe::Language::english;

  std::thread worker_;
};

}  // namespace palpable::page
