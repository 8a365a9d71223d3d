// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/touch_host.hpp"

#include "palpable/haptics/laws.hpp"
#include "palpable/page/page_scene.hpp"

#include <algorithm>
#include <utility>

namespace palpable::page {
namespace {

constexpr auto kRatePeriod = std::chrono::seconds(1);

protocol::State state_of(const haptics::TouchSample& sample) {
  protocol::State state;
  const Vec3 proxy = (sample.has(haptics::flag::kHasProxy) ? sample.proxy : sample.position).v;
  const Vec3 force = sample.written_force_N.v;
  state.t_s = sample.t_s;
  state.x_m = sample.position.v.x;
  state.y_m = sample.position.v.y;
  state.z_m = sample.position.v.z;
  state.proxy_x_m = proxy.x;
  state.proxy_y_m = proxy.y;
  state.proxy_z_m = proxy.z;
  state.fx_N = force.x;
  state.fy_N = force.y;
  state.fz_N = force.z;
  state.contact = sample.has(haptics::flag::kContact);
  state.label = sample.label;
  return state;
}

}  // namespace

TouchHost::TouchHost(session::TouchSession& session, Options options)
    : session_(session), options_(std::move(options)), worker_([this] { work(); }) {
  for (auto& sentence : session_.notices()) say("info", std::move(sentence));
}

TouchHost::~TouchHost() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  worker_.join();
}

protocol::Hello TouchHost::hello() const {
  return {protocol::kVersion, options_.program, session_.device_traits().name, pointer_moves()};
}

std::vector<protocol::Law> TouchHost::laws() const { return page_laws(*session_.scene()); }

std::shared_ptr<const PageScene> TouchHost::scene() {
  if (auto scene = session_.scene(); scene != shown_) {
    const auto number = page_scene_ ? static_cast<std::uint32_t>(page_scene_->about.scene) + 1 : 0U;
    if (page_scene_) say("info", "A finer version of the scene is in place");
    page_scene_ = page_scene(*scene, number, options_.name);
    shown_ = std::move(scene);
  }
  return page_scene_;
}

protocol::Settings TouchHost::settings() {
  const auto touch = session_.settings();
  const auto material = session_.scene()->materials.front();
  const auto laws = page_laws(*session_.scene());
  const auto law = std::find_if(laws.begin(), laws.end(),
                                [&](const auto& l) { return l.name == haptics::name_of(touch.law.law); });
  protocol::Settings now;
  {
    const std::lock_guard lock(mutex_);
    now.answers = answered_;
  }
  now.law = haptics::name_of(touch.law.law);
  now.stiffness = touch.law.stiffness_N_per_m.value_or(law != laws.end() ? law->stiffness_default
                                                                         : material.stiffness_N_per_m);
  now.damping_Ns_per_m = touch.law.damping_Ns_per_m.value_or(material.damping_Ns_per_m);
  now.friction = touch.law.static_friction.value_or(material.static_friction);
  now.exaggeration = touch.depth;
  now.paused = session_.paused();
  return now;
}

protocol::State TouchHost::state() {
  const auto sample = session_.latest();
  protocol::State state = state_of(sample);
  const auto scene = session_.scene();
  state.surface_m = session_.settings().depth * surface_height_m(*scene, state.x_m, state.y_m);
  if (const auto now = std::chrono::steady_clock::now(); now - rate_time_ > kRatePeriod) {
    rate_time_ = now;
    rate_hz_ = session_.statistics().servo.rate_hz;
  }
  state.rate_hz = rate_hz_;
  return state;
}

// A pointer that rests sends nothing, but it is still there: the device must hear so.
void TouchHost::beat() {
  place_pointer();
  if (!options_.take_better_scene) return;
  if (auto better = options_.take_better_scene()) {
    {
      const std::lock_guard lock(mutex_);
      better_ = std::move(better);
    }
    wake_.notify_one();
  }
}

void TouchHost::move(const protocol::Pointer& pointer) {
  pointer_ = pointer;
  place_pointer();
}

void TouchHost::place_pointer() {
  if (!pointer_moves()) return;
  const auto touch = session_.settings();
  // The hand is the middle of the ball that touches: at rest on the surface it is a radius above it.
  const double surface_m = touch.depth * surface_height_m(*session_.scene(), pointer_.x_m, pointer_.y_m);
  const Vec3 hand{pointer_.x_m, pointer_.y_m, surface_m + touch.law.radius_m - pointer_.press_m};
  session_.move_pointer({hand});
}

void TouchHost::change(const protocol::Change& wishes) {
  {
    const std::lock_guard lock(mutex_);
    wishes_ = wishes;
  }
  wake_.notify_one();
}

void TouchHost::pause(bool paused) {
  if (paused) {
    session_.pause();
  } else {
    session_.resume();
  }
}

void TouchHost::recentre() {
  // The page's own pointer goes to the middle by itself; a device's workspace is moved there.
  if (pointer_moves()) return;
  {
    const std::lock_guard lock(mutex_);
    recentre_ = true;
  }
  wake_.notify_one();
}

std::optional<protocol::Notice> TouchHost::next_notice() {
  take_notices();
  const std::lock_guard lock(mutex_);
  if (notices_.empty()) return {};
  auto notice = std::move(notices_.front());
  notices_.pop_front();
  return notice;
}

void TouchHost::take_notices() {
  using Kind = haptics::TouchEvent::Kind;
  for (const auto& event : session_.take_events()) {
    // A pointer is lost whenever no page is open; whoever opens one need not hear of it.
    if (event.kind == Kind::fault && !pointer_moves()) {
      const auto fault = session_.device_fault();
      say("fault", fault.empty() ? "The device does not answer: its force is off" : fault);
    } else if (event.kind == Kind::recovered && !pointer_moves()) {
      say("recovered", "The device answers again");
    } else if (event.kind == Kind::not_finite) {
      say("fault", "The law gave a force that is no number: the force is off");
    }
  }
}

void TouchHost::say(std::string level, std::string text) {
  const std::lock_guard lock(mutex_);
  notices_.push_back({std::move(level), std::move(text)});
}

void TouchHost::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ending_ || wishes_ || better_ || recentre_; });
    if (ending_) return;
    const auto wishes = std::exchange(wishes_, std::nullopt);
    const bool recentre = std::exchange(recentre_, false);
    const auto better = std::exchange(better_, nullptr);
    lock.unlock();
    if (better)
      if (const auto done = session_.change_scene(better); !done) say("warning", done.error().sentence());
    if (recentre) session_.recentre();
    if (wishes) carry_out(*wishes);
  }
}

void TouchHost::carry_out(const protocol::Change& wishes) {
  if (const auto done = attempt(wishes); !done) say("warning", done.error().sentence());
  const std::lock_guard lock(mutex_);
  answered_ = wishes.serial;
}

Result<void> TouchHost::attempt(const protocol::Change& wishes) {
  const auto law = haptics::law_from(wishes.law);
  if (!law) return Error{ErrorCode::usage, "there is no such law", wishes.law};
  auto touch = session_.settings();
  touch.law.law = *law;
  touch.law.stiffness_N_per_m = wishes.stiffness;
  touch.law.damping_Ns_per_m = wishes.damping_Ns_per_m;
  touch.law.static_friction = wishes.friction;
  touch.law.dynamic_friction.reset();
  touch.depth = wishes.exaggeration;
  const auto before = session_.notices();
  if (auto done = session_.change_settings(touch); !done) return done;
  if (auto notices = session_.notices(); notices != before)
    for (auto& sentence : notices) say("info", std::move(sentence));
  return {};
}

}  // namespace palpable::page
