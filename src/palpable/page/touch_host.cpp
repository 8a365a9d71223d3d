// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/touch_host.hpp"

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/page/page_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::page {
namespace {

constexpr auto kRatePeriod = std::chrono::seconds(1);
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kNeighbourhood_px = 3.0;
static_assert(protocol::kMostProbes == haptics::kMaxLiveProbes);

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

void add_further(protocol::State& state, const haptics::TouchSample& sample, double surface_m) {
  const protocol::State probe = state_of(sample);
  state.further.push_back(sample.probe);
  state.further_x_m.push_back(probe.x_m);
  state.further_y_m.push_back(probe.y_m);
  state.further_z_m.push_back(probe.z_m);
  state.further_surface_m.push_back(surface_m);
  state.further_fx_N.push_back(probe.fx_N);
  state.further_fy_N.push_back(probe.fy_N);
  state.further_fz_N.push_back(probe.fz_N);
  state.further_contact.push_back(probe.contact ? 1.0 : 0.0);
  state.further_label.push_back(static_cast<double>(probe.label));
}

/// m of eq. 7 as the scene was made with it; where there is none, the default.
double made_neighbourhood_px(const models::Scene& scene) {
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model);
  return contours != nullptr ? (*contours)->boundaries.radius_px() : kNeighbourhood_px;
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
  return {protocol::kVersion,
          options_.program,
          session_.device_traits().name,
          pointer_moves(),
          static_cast<std::int64_t>(session_.probes()),
          options_.egocentric};
}

std::vector<protocol::Law> TouchHost::laws() const { return page_laws(*session_.scene()); }

std::shared_ptr<const PageScene> TouchHost::scene() {
  auto scene = session_.scene();
  // Other materials alone are no other scene to look at.
  if (!shown_ || scene->model != shown_->model) {
    const auto number = page_scene_ ? static_cast<std::uint32_t>(page_scene_->about.scene) + 1 : 0U;
    if (page_scene_) say("info", "A finer version of the scene is in place");
    page_scene_ = page_scene(*scene, number, options_.name);
  }
  shown_ = std::move(scene);
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
  now.stiffness = (touch.law.*haptics::description_of(touch.law.law).strength)
                      .value_or(law != laws.end() ? law->stiffness_default : material.stiffness_N_per_m);
  now.damping_Ns_per_m = touch.law.damping_Ns_per_m.value_or(material.damping_Ns_per_m);
  now.friction = touch.law.static_friction.value_or(material.static_friction);
  now.exaggeration = touch.depth;
  now.neighbourhood_px = touch.law.neighbourhood_px.value_or(made_neighbourhood_px(*session_.scene()));
  now.paused = session_.paused();
  return now;
}

protocol::State TouchHost::state() {
  const auto sample = session_.latest();
  protocol::State state = state_of(sample);
  const auto scene = session_.scene();
  const double depth = session_.settings().depth;
  const auto surface_m = [&](double x_m, double y_m) { return depth * surface_height_m(*scene, x_m, y_m); };
  state.surface_m = surface_m(state.x_m, state.y_m);
  for (std::size_t probe = 1; probe < session_.probes(); ++probe)
    if (const auto further = session_.latest(probe); haptics::is_present(further))
      add_further(state, further, surface_m(further.position.v.x, further.position.v.y));
  if (const auto now = std::chrono::steady_clock::now(); now - rate_time_ > kRatePeriod) {
    rate_time_ = now;
    rate_hz_ = session_.statistics().servo.rate_hz;
  }
  state.rate_hz = rate_hz_;
  return state;
}

// A pointer that rests sends nothing, but it is still there: the device must hear so.
void TouchHost::beat() {
  for (const auto& pointer : pointers_)
    if (pointer) place(*pointer);
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
  const auto touch = session_.settings();
  // The probe is the middle of the ball that touches: at rest on the surface it is a radius above it.
  const double surface_m = touch.depth * surface_height_m(*session_.scene(), pointer.x_m, pointer.y_m);
  const Vec3 middle{pointer.x_m, pointer.y_m, surface_m + touch.law.radius_m.value_or(0.0) - pointer.press_m};
  session_.move_pointer({middle}, static_cast<std::size_t>(pointer.probe));
}

protocol::Materials TouchHost::materials() {
  static_assert(protocol::kPictureForms == models::kPictureForms,
                "the page tells a picture's side from its pitch");
  protocol::Materials all;
  {
    const std::lock_guard lock(mutex_);
    all.answers = answered_;
  }
  for (const auto& m : session_.scene()->materials) {
    all.names.push_back(m.name);
    all.stiffness_N_per_m.push_back(m.stiffness_N_per_m);
    all.damping_Ns_per_m.push_back(m.damping_Ns_per_m);
    all.friction.push_back(m.static_friction);
    all.stickiness.push_back(m.static_friction > 0.0 ? 1.0 - m.dynamic_friction / m.static_friction : 0.0);
    all.textures.emplace_back(models::name_of(m.texture.kind));
    all.pitch_m.push_back(m.texture.pitch_m);
    all.height_m.push_back(m.texture.height_m);
    all.angle_deg.push_back(std::remainder(m.texture.angle_rad * kDegrees, 360.0));
  }
  return all;
}

void TouchHost::put(const std::function<void(Tasks&)>& task) {
  {
    const std::lock_guard lock(mutex_);
    task(tasks_);
  }
  wake_.notify_one();
}

void TouchHost::change(const protocol::Change& wishes) {
  put([&](Tasks& tasks) {
    tasks.wishes = wishes;
    tasks.serial = wishes.serial;
  });
}

void TouchHost::edit(const protocol::Edit& wish) {
  put([&](Tasks& tasks) {
    tasks.edits[wish.label] = wish;
    tasks.serial = wish.serial;
  });
}

void TouchHost::save() {
  put([](Tasks& tasks) { tasks.save = true; });
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
  if (!pointer_moves()) put([](Tasks& tasks) { tasks.recentre = true; });
}

void TouchHost::stand(const protocol::Stand& stand) {
  if (!options_.egocentric) return;
  put([&](Tasks& tasks) {
    tasks.stance = session::Stance{stand.x_m, stand.y_m, stand.heading_deg / kDegrees};
  });
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
    // A pointer is lost whenever no page is open, a further probe whenever it is lifted; nobody need hear of
    // it.
    const bool device = event.probe == 0 && !pointer_moves();
    if (event.kind == Kind::fault && device) {
      const auto fault = session_.device_fault();
      say("fault", fault.empty() ? "The device does not answer: its force is off" : fault);
    } else if (event.kind == Kind::recovered && device) {
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
    wake_.wait(lock, [this] { return ending_ || tasks_.any(); });
    if (ending_) return;
    const Tasks tasks = std::exchange(tasks_, {});
    lock.unlock();
    carry_out(tasks);
  }
}

void TouchHost::carry_out(const Tasks& tasks) {
  if (tasks.better) tell([&] { return swap_in(*tasks.better); });
  if (tasks.recentre) session_.recentre();
  if (tasks.stance) tell([&] { return stand_there(*tasks.stance); });
  if (tasks.wishes) tell([&] { return attempt(*tasks.wishes); });
  if (!tasks.edits.empty()) tell([&] { return attempt(tasks.edits); });
  if (tasks.save) tell([&] { return write_scene(); });
  if (!tasks.wishes && tasks.edits.empty()) return;
  const std::lock_guard lock(mutex_);
  answered_ = tasks.serial;
}

void TouchHost::tell(const std::function<Result<void>()>& step) {
  const auto before = session_.notices();
  if (const auto done = step(); !done) say("warning", done.error().sentence());
  if (auto notices = session_.notices(); notices != before)
    for (auto& sentence : notices) say("info", std::move(sentence));
}

/// What was edited stays, where the better scene has the same materials.
Result<void> TouchHost::swap_in(const models::Scene& better) {
  models::Scene scene = better;
  const auto held = session_.scene();
  if (edited_ && held->materials.size() == scene.materials.size()) scene.materials = held->materials;
  return session_.change_scene(std::make_shared<const models::Scene>(std::move(scene)));
}

/// The page's own pointer goes along by itself, for it tells places of the scene.
Result<void> TouchHost::stand_there(const session::Stance& stance) {
  if (!pointer_moves())
    if (auto stood = session_.stand(stance); !stood) return stood;
  say("answer", session::words_of(stance));
  return {};
}

Result<void> TouchHost::write_scene() {
  if (auto written = formats::write_scene(options_.save_as, *session_.scene()); !written) return written;
  say("answer", "The scene is saved as " + options_.save_as.string());
  return {};
}

/// What is wished as the materials have it stays theirs, so that each keeps its own.
Result<void> TouchHost::attempt(const protocol::Change& wishes) {
  const auto law = haptics::law_from(wishes.law);
  if (!law) return Error{ErrorCode::usage, "there is no such law", wishes.law};
  const auto scene = session_.scene();
  const auto& material = scene->materials.front();
  const auto unless = [](double value, double held) {
    return value == held ? std::nullopt : std::optional(value);
  };
  double own_stiffness = material.stiffness_N_per_m;
  bool of_materials = true;
  for (const auto& known : page_laws(*scene)) {
    if (known.name != wishes.law) continue;
    own_stiffness = known.stiffness_default;
    of_materials = known.has_materials;
  }
  auto touch = session_.settings();
  touch.law.law = *law;
  touch.law.*haptics::description_of(*law).strength = unless(wishes.stiffness, own_stiffness);
  touch.law.damping_Ns_per_m = wishes.damping_Ns_per_m;
  if (of_materials) touch.law.damping_Ns_per_m = unless(wishes.damping_Ns_per_m, material.damping_Ns_per_m);
  touch.law.static_friction = unless(wishes.friction, material.static_friction);
  touch.law.dynamic_friction.reset();
  touch.law.neighbourhood_px = unless(wishes.neighbourhood_px, made_neighbourhood_px(*scene));
  touch.depth = wishes.exaggeration;
  return session_.change_settings(touch);
}

/// A value that is edited for one material holds for no longer by one wish for all of them.
Result<void> TouchHost::attempt(const std::map<std::int64_t, protocol::Edit>& edits) {
  auto materials = session_.scene()->materials;
  auto touch = session_.settings();
  for (const auto& [label, wish] : edits) {
    const auto kind = models::texture_kind_from(wish.texture);
    if (label < 0 || static_cast<std::size_t>(label) >= materials.size() || !kind)
      return Error{ErrorCode::usage, "there is no such material or texture", wish.texture};
    models::Material& m = materials[static_cast<std::size_t>(label)];
    if (m.stiffness_N_per_m != wish.stiffness_N_per_m) touch.law.stiffness_N_per_m.reset();
    if (m.damping_Ns_per_m != wish.damping_Ns_per_m) touch.law.damping_Ns_per_m.reset();
    m.stiffness_N_per_m = wish.stiffness_N_per_m;
    m.damping_Ns_per_m = wish.damping_Ns_per_m;
    const double sliding = wish.friction * (1.0 - wish.stickiness);
    if (m.static_friction != wish.friction || m.dynamic_friction != sliding) {
      touch.law.static_friction.reset();
      touch.law.dynamic_friction.reset();
    }
    m.static_friction = wish.friction;
    m.dynamic_friction = sliding;
    if (*kind == models::TouchTexture::Kind::picture && m.texture.tile.empty())
      return Error{ErrorCode::usage, "this material has no texture from a picture", wish.texture};
    // A picture's tile stays, so that a person may come back to it.
    m.texture = {*kind, wish.pitch_m, wish.height_m, wish.angle_deg / kDegrees, std::move(m.texture.tile)};
  }
  if (auto done = session_.change_materials(std::move(materials), touch); !done) return done;
  edited_ = true;
  return {};
}

}  // namespace palpable::page
