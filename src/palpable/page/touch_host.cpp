// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/touch_host.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/page/page_laws.hpp"
#include "palpable/page/page_scene.hpp"
#include "palpable/page/page_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::page {
namespace {

constexpr auto kRatePeriod = std::chrono::seconds(1);
constexpr double kDegrees = 180.0 / std::numbers::pi;
static_assert(protocol::kMostProbes == haptics::kMaxLiveProbes);

}  // namespace

TouchHost::TouchHost(session::TouchSession& session, Options options)
    : session_(session),
      options_(std::move(options)),
      outages_(session.hands()),
      unsaved_(options_.save_as),
      worker_([this] { work(); }) {
  for (auto& sentence : session_.notices()) say("info", std::move(sentence));
  if (const auto file = formats::UnsavedScene::of_earlier_touch(options_.save_as); !file.empty())
    say("info", describe::phrase("Names of an earlier touch that were not saved are in {}", file.string()));
}

TouchHost::~TouchHost() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  worker_.join();
}

protocol::Words TouchHost::answer(const protocol::Ask& ask) {
  const auto probe = static_cast<std::size_t>(ask.probe);
  const double force_N = probe < session_.probes() ? norm(session_.latest(probe).written_force_N.v) : 0.0;
  auto words = words_.answer(ask, *named_scene(), session_.settings().height_factor, force_N);
  const bool is_first = page_scene_ == nullptr || page_scene_->about.scene == 0;
  if (ask.what == "opening" && options_.better_follows && is_first)
    words.text += std::string(" ") +
                  describe::tr("A finer version of the scene is being made: it takes its place by itself.");
  return words;
}

protocol::Around TouchHost::around(const protocol::LookAround& question) {
  return words_.names().around(*named_scene(), question);
}

std::shared_ptr<const models::Scene> TouchHost::named_scene() {
  auto touched = session_.scene();
  if (touched == unnamed_ && named_) return named_;
  const std::lock_guard lock(mutex_);
  unnamed_ = touched;
  named_ = std::move(touched);
  if (edited_names_) {
    auto named = std::make_shared<models::Scene>(*unnamed_);
    named->names = *edited_names_;
    named_ = std::move(named);
  }
  return named_;
}

models::Scene TouchHost::with_edited_names(models::Scene scene) {
  const std::lock_guard lock(mutex_);
  if (edited_names_) scene.names = *edited_names_;
  return scene;
}

bool TouchHost::has_edited_names() {
  const std::lock_guard lock(mutex_);
  return edited_names_.has_value();
}

template <class Edit>
void TouchHost::edit_names(const Edit& edit) {
  auto edited = words_.names().edited(*named_scene(), edit);
  if (!edited) return say("answer", describe::capitalised(edited.error().message) + ".");
  {
    const std::lock_guard lock(mutex_);
    edited_names_ = std::move(edited->names);
  }
  named_.reset();
  put([&](Tasks& tasks) {
    tasks.keep = true;
    tasks.edited_words.emplace_back(PageNames::level_of(edit), std::move(edited->words));
  });
}

void TouchHost::find(const protocol::Find& find) {
  const auto scene = named_scene();
  const auto seen = words_.names().find(*scene, find);
  if (!seen) say("answer", describe::capitalised(seen.error().message) + ".", find.probe);
  // Only the hand is pulled.
  if (find.probe != 0) return;
  end_pull();
  if (pointer_moves() || !seen || !*seen || (*seen)->distance_m == 0.0) return;
  const Place from{find.x_m, find.y_m};
  auto guide = pull_.begin(*scene, session_.device_traits(), from, (*seen)->at);
  if (guide == nullptr) return;
  own_guide_ = scene->guide;
  put([&](Tasks& tasks) { tasks.guide = std::move(guide); });
}

void TouchHost::end_pull() {
  if (!pull_.pulls()) return;
  pull_.end();
  put([&](Tasks& tasks) { tasks.guide = own_guide_; });
}

void TouchHost::watch_pull() {
  constexpr auto kPeriod = std::chrono::milliseconds(200);
  const auto now = std::chrono::steady_clock::now();
  if (!pull_.pulls() || now - watched_ < kPeriod) return;
  watched_ = now;
  const Vec3 at = session_.latest().position.v;
  const auto scene = named_scene();
  if (pull_.is_pushed_away(*scene, {at.x, at.y})) {
    say("info", describe::tr("The pull has ended: the hand was moved away."));
    end_pull();
  } else if (!words_.names().seen(*scene, 0, {at.x, at.y})) {
    end_pull();
  }
}

protocol::Hello TouchHost::hello() const {
  protocol::Hello hello;
  hello.version = protocol::kVersion;
  hello.program = options_.program;
  for (std::size_t hand = 0; hand < session_.hands(); ++hand)
    hello.device += (hand > 0 ? ", " : "") + session_.device_traits(hand).name;
  hello.pointer_moves = pointer_moves();
  hello.hands = static_cast<std::int64_t>(session_.hands());
  hello.probes = static_cast<std::int64_t>(session_.probes());
  hello.egocentric = options_.egocentric;
  hello.home = options_.home;
  return hello;
}

protocol::Laws TouchHost::laws() const { return page_laws(*session_.scene(), session_.device_traits()); }

std::shared_ptr<const PageScene> TouchHost::scene() {
  auto scene = session_.scene();
  // A change of materials alone does not change the view.
  if (!shown_ || scene->model != shown_->model) {
    // Every frame of a live source is felt, but the eye needs few of them.
    constexpr auto kLivePicturePeriod = std::chrono::milliseconds(500);
    const auto now = std::chrono::steady_clock::now();
    if (page_scene_ && options_.live && now - shown_time_ < kLivePicturePeriod) return page_scene_;
    shown_time_ = now;
    const auto number = page_scene_ ? static_cast<std::uint32_t>(page_scene_->about.scene) + 1 : 0U;
    if (page_scene_ && !options_.live) say("info", "A finer version of the scene is in place.");
    page_scene_ = page_scene(*scene, number, options_.name);
  }
  shown_ = std::move(scene);
  return page_scene_;
}

protocol::Settings TouchHost::settings() {
  const auto touch = session_.settings();
  const auto law = session_.law_in_use();
  protocol::Settings now;
  {
    const std::lock_guard lock(mutex_);
    now.answers = answered_;
  }
  now.law = haptics::name_of(law);
  now.parameters = parameter_values(*session_.scene(), law, touch.law);
  now.height_factor = touch.height_factor;
  now.paused = session_.paused();
  return now;
}

std::optional<protocol::Robot> TouchHost::robot() {
  if (options_.robot == nullptr) return std::nullopt;
  return robot_news_.take(page_robot(options_.robot->state()), std::chrono::steady_clock::now());
}

std::optional<protocol::RobotFloor> TouchHost::robot_floor() {
  const auto floor = options_.robot != nullptr ? options_.robot->floor() : nullptr;
  return floor ? std::optional(page_floor(*floor)) : std::nullopt;
}

void TouchHost::order(const protocol::RobotOrder& order) {
  if (options_.robot == nullptr) return;
  // The page's pointer may rest anywhere, and would drive the robot at once.
  if (order.word == "start" && pointer_moves()) move(kAtRest);
  static_cast<void>(session::obey(order.word, *options_.robot));
}

void TouchHost::let_go() {
  if (options_.robot != nullptr && pointer_moves()) options_.robot->request_stop();
}

protocol::State TouchHost::state() {
  const auto sample = session_.latest();
  const auto scene = named_scene();
  const double height_factor = session_.settings().height_factor;
  protocol::State state;
  state.t_s = sample.t_s;
  state.probes.push_back(probe_state(sample, *scene, height_factor));
  for (std::size_t probe = 1; probe < session_.probes(); ++probe)
    if (const auto further = session_.latest(probe); haptics::is_present(further))
      state.probes.push_back(probe_state(further, *scene, height_factor));
  if (const auto now = std::chrono::steady_clock::now(); now - rate_time_ > kRatePeriod) {
    rate_time_ = now;
    rate_hz_ = session_.statistics().servo.rate_hz;
  }
  state.rate_hz = rate_hz_;
  state.device = device_place(session_.scene_from_device());
  for (auto& remark : words_.remarks(state, *scene, height_factor))
    say(std::move(remark.level), std::move(remark.text), remark.probe);
  return state;
}

// A pointer at rest sends nothing; without these updates the device would count it as lost. With a robot the
// page says itself that it rests, since one that hangs must not go on driving.
void TouchHost::update() {
  for (const auto& pointer : pointers_)
    if (pointer && !(options_.robot != nullptr && pointer->probe == 0)) place(*pointer);
  watch_pull();
  if (!options_.take_better_scene) return;
  if (auto better = options_.take_better_scene())
    put([&](Tasks& tasks) { tasks.better = std::move(better); });
}

void TouchHost::move(const protocol::Pointer& pointer) {
  pointers_.at(static_cast<std::size_t>(pointer.probe)) = pointer;
  place(pointer);
}

void TouchHost::lift(const protocol::Lift& probe) {
  const auto number = static_cast<std::size_t>(probe.probe);
  pointers_.at(number).reset();
  session_.lift_pointer(number);
}

void TouchHost::place(const protocol::Pointer& pointer) {
  if (pointer.probe == 0 && !pointer_moves()) return;
  session_.move_pointer(pointer_place(pointer, *session_.scene(), session_.settings().height_factor,
                                      session_.radius_in_use_m()),
                        static_cast<std::size_t>(pointer.probe));
}

protocol::Materials TouchHost::materials() {
  protocol::Materials all;
  {
    const std::lock_guard lock(mutex_);
    all.answers = answered_;
  }
  all.materials = page_materials(*session_.scene());
  return all;
}

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
    tasks.pose = session::ExplorerPose{pose.x_m, pose.y_m, pose.heading_deg / kDegrees};
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
