// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/browser_touch.hpp"

#include "palpable/describe/numbers.hpp"
#include "palpable/haptics/servo/servo_options.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/page/page_laws.hpp"
#include "palpable/page/page_scene.hpp"
#include "palpable/page/page_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::onefile {
namespace {

namespace protocol = page::protocol;

haptics::TickOptions browser_tick_options() {
  haptics::ServoOptions options;
  options.rate_hz = BrowserTouch::kRate_hz;
  return haptics::tick_options(options);
}

device::Traits pointer_traits() {
  return device::PointerDevice(std::make_shared<device::PointerFeed>(), BrowserTouch::kRate_hz).traits();
}

}  // namespace

BrowserTouch::Probe::Probe(const haptics::HapticScene& scene, Ring<haptics::TouchEvent>& events,
                           std::uint8_t number)
    : feed(std::make_shared<device::PointerFeed>()),
      device(feed, kRate_hz),
      tick(device, scene, browser_tick_options(), events, number) {
  latest.status = device::Status::not_ready;
  latest.probe = number;
}

Result<std::unique_ptr<BrowserTouch>> BrowserTouch::open(std::shared_ptr<const models::Scene> scene) {
  std::unique_ptr<BrowserTouch> touch(new BrowserTouch(std::move(scene)));
  touch->scene_from_device_ = haptics::fit_workspace(*touch->scene_, pointer_traits());
  touch->page_scene_ = page::page_scene(*touch->scene_, 0, {});
  if (auto prepared = touch->prepare(touch->scene_, touch->settings_); !prepared) return prepared.error();
  touch->rendered_.push_back(std::exchange(touch->waiting_, nullptr));
  for (std::size_t i = 0; i < touch->probes_.size(); ++i)
    touch->probes_[i] =
        std::make_unique<Probe>(*touch->rendered_.front(), touch->events_, static_cast<std::uint8_t>(i));
  // The first probe is above the surface until it is moved.
  constexpr double kAbove_m = 0.02;
  touch->probes_.front()->pointer = protocol::Pointer{0, 0.0, 0.0, -kAbove_m};
  return touch;
}

Result<void> BrowserTouch::prepare(std::shared_ptr<const models::Scene> scene,
                                   const session::TouchSettings& settings) {
  auto prepared =
      session::prepare_scene(*scene, settings, pointer_traits(), kRate_hz, scene_from_device_, kept_, {});
  if (!prepared) return std::move(prepared).error();
  prepared->scene.id = ++last_scene_id_;
  waiting_ = std::make_unique<const haptics::HapticScene>(std::move(prepared->scene));
  scene_ = std::move(scene);
  settings_ = settings;
  law_in_use_ = prepared->law;
  for (auto& sentence : prepared->notices) say("info", std::move(sentence));
  return {};
}

bool BrowserTouch::fading() const {
  return std::any_of(probes_.begin(), probes_.end(), [](const auto& probe) { return probe->tick.fading(); });
}

void BrowserTouch::swap_scenes() {
  if ((waiting_ == nullptr && rendered_.size() == 1) || fading()) return;
  for (const auto& probe : probes_) probe->tick.take_retired();
  rendered_.erase(rendered_.begin(), rendered_.end() - 1);
  if (waiting_ == nullptr) return;
  rendered_.push_back(std::exchange(waiting_, nullptr));
  for (const auto& probe : probes_) probe->tick.change(*rendered_.back());
}

void BrowserTouch::place(Probe& probe) const {
  const auto middle = page::pointer_place(*probe.pointer, *scene_, settings_.height_factor,
                                          law_in_use_.radius_m.value_or(0.0));
  probe.feed->put(scene_from_device_.inverse() * middle);
}

void BrowserTouch::advance(double seconds) {
  constexpr double kPeriod_s = 1.0 / kRate_hz;
  rest_s_ = std::min(rest_s_ + std::max(0.0, seconds), kMostAtOnce_s);
  // A pointer at rest sends nothing; without these updates its device would count it as lost.
  for (const auto& probe : probes_)
    if (probe->pointer) place(*probe);
  while (rest_s_ >= kPeriod_s) {
    rest_s_ -= kPeriod_s;
    swap_scenes();
    const double t_s = static_cast<double>(ticks_++) * kPeriod_s;
    for (const auto& probe : probes_) probe->latest = probe->tick.step(t_s, kPeriod_s);
  }
  while (const auto event = events_.take())
    if (event->kind == haptics::TouchEvent::Kind::not_finite)
      say("fault", "The law gave a force that is not a number: the force is off");
}

protocol::Hello BrowserTouch::hello() const {
  protocol::Hello hello;
  hello.version = protocol::kVersion;
  hello.program = scene_->source.made_by;
  hello.device = pointer_traits().name;
  hello.pointer_moves = true;
  hello.probes = static_cast<std::int64_t>(probes_.size());
  return hello;
}

protocol::Laws BrowserTouch::laws() const { return page::page_laws(*scene_, pointer_traits()); }

protocol::Settings BrowserTouch::settings() {
  protocol::Settings now;
  now.answers = answered_;
  now.law = haptics::name_of(law_in_use_.law);
  now.parameters = page::parameter_values(*scene_, law_in_use_.law, settings_.law);
  now.height_factor = settings_.height_factor;
  now.paused = paused_;
  return now;
}

protocol::Materials BrowserTouch::materials() {
  protocol::Materials all;
  all.answers = answered_;
  all.materials = page::page_materials(*scene_);
  return all;
}

protocol::State BrowserTouch::state() {
  protocol::State state;
  state.t_s = probes_.front()->latest.t_s;
  state.rate_hz = kRate_hz;
  for (const auto& probe : probes_)
    if (probe == probes_.front() || haptics::is_present(probe->latest))
      state.probes.push_back(page::probe_state(probe->latest, *scene_, settings_.height_factor));
  for (auto& remark : words_.remarks(state, *scene_, settings_.height_factor))
    say(std::move(remark.level), std::move(remark.text));
  return state;
}

void BrowserTouch::move(const protocol::Pointer& pointer) {
  probes_.at(static_cast<std::size_t>(pointer.probe))->pointer = pointer;
}

void BrowserTouch::lift(const protocol::Lift& lifted) {
  Probe& probe = *probes_.at(static_cast<std::size_t>(lifted.probe));
  probe.pointer.reset();
  probe.feed->put(std::nullopt);
}

void BrowserTouch::change(const protocol::Change& change) { report(attempt(change), change.serial); }
void BrowserTouch::edit(const protocol::Edit& edit) { report(attempt(edit), edit.serial); }

void BrowserTouch::report(const Result<void>& done, std::int64_t serial) {
  if (!done) say("warning", done.error().sentence());
  answered_ = serial;
}

Result<void> BrowserTouch::attempt(const protocol::Change& change) {
  auto settings = settings_;
  const auto law = page::requested_parameters(settings.law, change);
  if (!law) return law.error();
  settings.law = *law;
  settings.height_factor = change.height_factor;
  return prepare(scene_, settings);
}

Result<void> BrowserTouch::attempt(const protocol::Edit& edit) {
  auto settings = settings_;
  page::MaterialEdits edits;
  page::add_edit(edits, edit);
  auto materials = page::edited_materials(scene_->materials, edits, settings.law);
  if (!materials) return materials.error();
  auto changed = session::with_materials(*scene_, *std::move(materials));
  if (!changed) return changed.error();
  return prepare(std::make_shared<const models::Scene>(*std::move(changed)), settings);
}

void BrowserTouch::save() { say("answer", describe::tr("This page is a file of its own and saves none.")); }

void BrowserTouch::pause(bool paused) {
  paused_ = paused;
  for (const auto& probe : probes_) probe->tick.set_paused(paused);
}

page::protocol::Words BrowserTouch::answer(const protocol::Ask& ask) {
  const double force_N = norm(probes_.at(static_cast<std::size_t>(ask.probe))->latest.written_force_N.v);
  return words_.answer(ask, *scene_, settings_.height_factor, force_N);
}

protocol::Around BrowserTouch::around(const protocol::LookAround& question) {
  return words_.names().around(*scene_, question);
}

template <class Edit>
void BrowserTouch::edit_names(const Edit& edit) {
  auto edited = words_.names().edited(*scene_, edit);
  if (!edited) return say("answer", describe::capitalised(edited.error().message) + ".");
  auto named = std::make_shared<models::Scene>(*scene_);
  named->names = std::move(edited->names);
  scene_ = std::move(named);
  say(page::PageNames::level_of(edit), std::move(edited->words));
}

void BrowserTouch::find(const protocol::Find& find) {
  if (const auto seen = words_.names().find(*scene_, find); !seen)
    say("answer", describe::capitalised(seen.error().message) + ".");
}

std::optional<protocol::Notice> BrowserTouch::next_notice() {
  if (notices_.empty()) return std::nullopt;
  auto notice = std::move(notices_.front());
  notices_.pop_front();
  return notice;
}

void BrowserTouch::say(std::string level, std::string text) {
  notices_.push_back({std::move(level), std::move(text)});
}

}  // namespace palpable::onefile
