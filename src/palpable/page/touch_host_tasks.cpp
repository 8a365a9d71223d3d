// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a touch host does on its own thread: changes that take longer than a frame.
#include "palpable/describe/language.hpp"
#include "palpable/page/page_laws.hpp"
#include "palpable/page/touch_host.hpp"

#include <numbers>
#include <utility>

namespace palpable::page {

void TouchHost::put(const std::function<void(Tasks&)>& task) {
  {
    const std::lock_guard lock(mutex_);
    task(tasks_);
  }
  wake_.notify_one();
}

void TouchHost::change(const protocol::Change& change) {
  put([&](Tasks& tasks) {
    tasks.change = change;
    tasks.serial = change.serial;
  });
}

void TouchHost::edit(const protocol::Edit& edit) {
  put([&](Tasks& tasks) {
    add_edit(tasks.edits, edit);
    tasks.serial = edit.serial;
  });
}

void TouchHost::save() {
  put([](Tasks& tasks) { tasks.save = true; });
}

void TouchHost::pause(bool paused) {
  if (paused) {
    if (options_.robot != nullptr) options_.robot->request_stop();
    session_.pause();
  } else {
    session_.resume();
  }
}

void TouchHost::recentre() {
  // The page's own pointer moves to the middle by itself; a device's workspace is moved there.
  if (!pointer_moves()) put([](Tasks& tasks) { tasks.recentre = true; });
}

void TouchHost::move_explorer(const protocol::MoveExplorer& pose) {
  if (!options_.egocentric) return;
  put([&](Tasks& tasks) {
    tasks.pose = session::ExplorerPose{pose.x_m, pose.y_m, pose.heading_deg * std::numbers::pi / 180.0};
  });
}

void TouchHost::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ending_ || tasks_.any(); });
    if (ending_) return;
    const Tasks tasks = std::exchange(tasks_, {});
    lock.unlock();
    carry_out(tasks);
  }
}

void TouchHost::carry_out(const Tasks& tasks) {
  const describe::LanguageScope scope(language_);
  if (tasks.better) report([&] { return swap_in(*tasks.better); });
  if (tasks.recentre) session_.recentre();
  if (tasks.guide) report([&] { return session_.change_guide(*tasks.guide); });
  if (tasks.pose) report([&] { return set_explorer_pose(*tasks.pose); });
  if (tasks.change) report([&] { return attempt(*tasks.change); });
  if (!tasks.edits.empty()) report([&] { return attempt(tasks.edits); });
  if (tasks.keep && !tasks.save) report([&] { return keep_names(); });
  for (const auto& [level, words] : tasks.edited_words) say(level, words);
  if (tasks.save) report([&] { return write_scene(); });
  if (!tasks.change && tasks.edits.empty()) return;
  const std::lock_guard lock(mutex_);
  answered_ = tasks.serial;
}

void TouchHost::report(const std::function<Result<void>()>& step) {
  const auto before = session_.notices();
  if (const auto done = step(); !done) say("warning", done.error().sentence());
  if (auto notices = session_.notices(); notices != before)
    for (auto& sentence : notices) say("info", std::move(sentence));
}

/// Edited materials are kept if the finer scene has the same number.
Result<void> TouchHost::swap_in(const models::Scene& better) {
  models::Scene scene = better;
  const auto held = session_.scene();
  if (edited_ && held->materials.size() == scene.materials.size()) scene.materials = held->materials;
  auto changed = session_.change_scene(std::make_shared<const models::Scene>(std::move(scene)));
  // What was kept of the scene before has been replaced.
  return changed && has_edited_names() ? keep_names() : changed;
}

/// The page's own pointer follows by itself, since it sends places in the scene frame.
Result<void> TouchHost::set_explorer_pose(const session::ExplorerPose& pose) {
  if (!pointer_moves())
    if (auto moved = session_.move_explorer(pose); !moved) return moved;
  say("answer", session::words_of(pose));
  return {};
}

Result<void> TouchHost::write_scene() {
  const models::Scene scene = with_edited_names(*session_.scene());
  // What is saved is kept, too; if it cannot be, it is saved all the same.
  if (options_.keep) static_cast<void>(options_.keep(scene));
  if (auto saved = unsaved_.save(scene); !saved) return saved;
  say("answer", describe::phrase("The scene is saved as {}", options_.save_as.string()));
  return {};
}

/// Where an unsaved copy is, is said once.
Result<void> TouchHost::keep_names() {
  const models::Scene scene = with_edited_names(*session_.scene());
  if (options_.keep && options_.keep(scene)) return {};
  const bool had_none = unsaved_.file().empty();
  if (auto kept = unsaved_.keep(scene); !kept) return kept;
  if (had_none && !unsaved_.file().empty())
    say("info", describe::phrase("Until you save, names are kept in {}", unsaved_.file().string()));
  return {};
}

Result<void> TouchHost::attempt(const protocol::Change& change) {
  auto touch = session_.settings();
  auto law = requested_parameters(touch.law, change);
  if (!law) return law.error();
  touch.law = *law;
  touch.height_factor = change.height_factor;
  return session_.change_settings(touch);
}

Result<void> TouchHost::attempt(const MaterialEdits& edits) {
  auto touch = session_.settings();
  auto materials = edited_materials(session_.scene()->materials, edits, touch.law);
  if (!materials) return materials.error();
  if (auto done = session_.change_materials(*std::move(materials), touch); !done) return done;
  edited_ = true;
  return {};
}

}  // namespace palpable::page
