// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/replayed_touch.hpp"

#include "palpable/device/recording/replay.hpp"
#include "palpable/haptics/servo/real_time.hpp"
#include "palpable/haptics/tick/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::session {
namespace {

namespace flag = haptics::flag;

}  // namespace

struct ReplayedTouch::Running {
  /// Returns the reading that was set.
  struct FedDevice final : device::Device {
    explicit FedDevice(const device::Traits& of) : its_traits(of) {}
    const device::Traits& traits() const noexcept override { return its_traits; }
    device::Reading read() noexcept override { return reading; }
    void write(Vector<DeviceFrame>) noexcept override {}
    void stop() noexcept override {}

    device::Reading reading;
    device::Traits its_traits;
  };

  Running(const RecordedSession& session, const haptics::HapticScene& scene)
      : device(*session.traits), tick(device, scene, session.tick, events) {}

  FedDevice device;
  Ring<haptics::TouchEvent> events{64};
  haptics::TickPipeline tick;
};

ReplayedTouch::ReplayedTouch(const RecordedSession& session, RecordedScenes& scenes)
    : session_(session), scenes_(scenes) {}
ReplayedTouch::~ReplayedTouch() = default;

bool ReplayedTouch::lose(std::string why) {
  why_ = std::move(why);
  if (running_) counts_ = running_->tick.counts();
  running_.reset();
  lost_ = true;
  return false;
}

haptics::TickCounts ReplayedTouch::counts() const { return running_ ? running_->tick.counts() : counts_; }

bool ReplayedTouch::begin(const device::TouchSample& first) {
  if (!session_.traits) return lose("an older program recorded it, without the device's traits");
  if (!session_.has_our_estimator) return lose("a program with another velocity estimator recorded it");
  if (first.tick != 0) return lose("it begins within a touch");
  // A change in the first tick: the touch began with the previous scene.
  const haptics::HapticScene* scene = scenes_.scene(first.scene_id);
  if (scene == nullptr) return lose(scenes_.why());
  running_ = std::make_unique<Running>(session_, *scene);
  return true;
}

bool ReplayedTouch::change_scene(const device::TouchSample& recorded) {
  auto& tick = running_->tick;
  if (!recorded.has(flag::kFading) || tick.fading()) return true;
  const std::uint32_t id = recorded.coming_scene_id != 0 ? recorded.coming_scene_id : recorded.scene_id;
  const haptics::HapticScene* next = scenes_.scene(id);
  if (next == nullptr) return lose(scenes_.why());
  tick.change(*next);
  return true;
}

const device::TouchSample* ReplayedTouch::step(const device::TouchSample& recorded) {
  if (lost_) return nullptr;
  if (!running_ && !begin(recorded)) return nullptr;
  if (recorded.tick != next_tick_ && !lose("ticks before it are missing")) return nullptr;
  ++next_tick_;
  if (!change_scene(recorded)) return nullptr;
  running_->device.reading = device::recorded_reading(recorded);
  const device::TouchSample* sample = nullptr;
  {
    const haptics::ServoArithmetic arithmetic;
    sample = &running_->tick.step(recorded.t_s, recorded.dt_s);
  }
  while (running_->events.take()) {
  }
  if (running_->tick.take_retired() != nullptr) scenes_.forget_before(sample->scene_id);
  return sample;
}

ReplayedHand::ReplayedHand(const RecordedSession& session) {
  if (session.repeats()) motion_.emplace(*session.traits, session.tick);
}

void ReplayedHand::step(const device::TouchSample& recorded) {
  recorded_ = recorded;
  if (!motion_) return;
  passed_s_ += recorded.dt_s;
  // As TickPipeline: after both, earlier readings say nothing.
  if (recorded.has(flag::kStalled | flag::kNewTouch)) motion_->begin();
  if (recorded.status != device::Status::ok || recorded.has(flag::kNoReading)) return;
  motion_->update(recorded.device_position, passed_s_);
  passed_s_ = 0.0;
}

haptics::Hand ReplayedHand::in(const haptics::HapticScene& scene) const {
  haptics::Hand hand{recorded_.position, recorded_.velocity_m_per_s, recorded_.dt_s};
  if (motion_) {
    hand.acts_after_s = motion_->acts_after_s(recorded_.dt_s);
    hand.gains_m_per_s = scene.scene_from_device * motion_->gains_m_per_s();
  }
  hand.rotation = haptics::rotation_in_scene(scene.scene_from_device, recorded_.device_rotation);
  hand.angular_velocity_rad_per_s = recorded_.angular_velocity_rad_per_s;
  return hand;
}

std::optional<haptics::LawOutput> ReplayedLaw::step(const device::TouchSample& recorded) {
  hand_.step(recorded);
  const bool follows = recorded.tick == next_tick_ && recorded.scene_id == scene_id_;
  next_tick_ = recorded.tick + 1;
  scene_id_ = recorded.scene_id;
  if (recorded.has(flag::kFading | flag::kNotFinite)) known_ = false;
  if (!follows) known_ = false;
  const bool good = recorded.status == device::Status::ok && !recorded.has(flag::kNoReading);
  const bool is_new = recorded.has(flag::kNewTouch), is_free = !recorded.has(flag::kContact);
  const bool begins = good && !recorded.has(flag::kFading) && (is_new || (!known_ && is_free));
  if (begins) {
    state_ = {};
    assumed_ = !is_new;
  }
  if (!(known_ || begins) || !good) return std::nullopt;
  const haptics::HapticScene* scene = scenes_.scene(recorded.scene_id);
  if (scene == nullptr) return std::nullopt;
  const haptics::ServoArithmetic arithmetic;
  const haptics::LawOutput output = scene->touchable->evaluate(hand_.in(*scene), state_);
  known_ = known_ || is_new || !output.contact;
  return output;
}

}  // namespace palpable::session
