// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/touch_host.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/page/page_head.hpp"
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
  hello.finds_head = options_.head != nullptr;
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

std::optional<protocol::Head> TouchHost::head() {
  if (options_.head == nullptr) return std::nullopt;
  const auto news = options_.head->take_news();
  return news ? std::optional(page_head(*news, std::chrono::steady_clock::now())) : std::nullopt;
}

void TouchHost::follow_head(const protocol::FollowHead& follow) {
  if (options_.head != nullptr) options_.head->follow(follow.follows, follow.down_deg / kDegrees);
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
  if (options_.head != nullptr)
    if (auto sentence = options_.head->take_notice()) say("info", *std::move(sentence));
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

}  // namespace palpable::page
