// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/remote/remote_device.hpp"
#include "palpable/device/remote/shared_device.hpp"
#include "palpable/haptics/law/local_touch.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/session/share/shared_limits.hpp"
#include "palpable/session/share/shared_textures.hpp"
#include "palpable/session/share/virtual_link.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/sent_textures.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

// For tests.
namespace palpable::session {

enum class SentTextures : std::uint8_t { none, all };

/// Two computers in simulated time, at 1000 ticks a second each: one with a device, one with a scene, and a
/// virtual link between them. Everything but sockets and threads is the program's own.
class RemoteBench {
 public:
  static constexpr double kTick_s = 0.001;

  RemoteBench(std::unique_ptr<device::Device> device, const models::Scene& scene,
              const TouchSettings& settings, const LinkQuality& quality,
              SentTextures sent = SentTextures::all)
      : up_(quality, 1), down_(quality, 2), traits_(device->traits()) {
    shared_->connected = true;
    const auto current = std::make_shared<device::CurrentSurface>();
    host_ =
        std::make_unique<device::SharedDevice>(std::move(device), shared_, current, [this] { return t_s_; });
    const auto place = haptics::fit_workspace(scene, traits_);
    KeptSurfaces kept;
    auto prepared = prepare_scene(scene, settings, traits_, 1.0 / kTick_s, place, kept);
    if (sent == SentTextures::all)
      for (const device::LocalTexture& texture : sent_textures(prepared->materials)) textures_.put(texture);
    local_.touchable = std::make_shared<const haptics::LocalTouch>(kind_of(*prepared->scene.touchable),
                                                                   current, textures_.textures());
    near_ = std::make_unique<haptics::TickPipeline>(*host_, local_, haptics::tick_options(shared_servo({})),
                                                    events_);
    client_ = std::make_unique<device::RemoteDevice>(traits_, remote_, 1.0 / kTick_s, nullptr);
    far_scene_ = std::move(prepared->scene);
    haptics::TickOptions far = haptics::tick_options({});
    far.ramp_loads = false;
    far_ = std::make_unique<haptics::TickPipeline>(*client_, far_scene_, far, far_events_);
  }

  /// One tick of both.
  const haptics::TouchSample& step() {
    t_s_ += kTick_s;
    const haptics::TouchSample& sample = near_->step(t_s_, kTick_s);
    device::RemoteReading reading;
    if (shared_->readings.take(reading)) up_.put(t_s_, reading);
    if (const auto arrived = up_.take(t_s_)) remote_->readings.put(*arrived);
    far_sample_ = far_->step(t_s_, kTick_s);
    const auto taken = remote_->surfaces.take(kTick_s);
    down_.put(t_s_, taken.command);
    if (const auto arrived = down_.take(t_s_))
      shared_->surfaces.put(limited_surface(*arrived, traits_, 1.0 / kTick_s,
                                            haptics::kLeastHandDamping_Ns_per_m,
                                            textures_.stiffening(arrived->texture.number)));
    return sample;
  }
  void cut_link(bool is_cut) {
    up_.cut(is_cut);
    down_.cut(is_cut);
  }
  /// As the host does when a connection ends, for whatever reason, and comes back.
  void set_connected(bool is_connected) { shared_->connected = is_connected; }
  const haptics::TickCounts& counts() const { return near_->counts(); }
  const haptics::TouchSample& far_sample() const { return far_sample_; }
  const haptics::HapticScene& far_scene() const { return far_scene_; }
  double t_s() const { return t_s_; }

 private:
  /// As the host finds it in the surfaces that come.
  static device::LocalSurface::Kind kind_of(const haptics::Touchable& touchable) {
    using Kind = device::LocalSurface::Kind;
    const haptics::EnergyModel energy = touchable.energy_model();
    if (energy == haptics::EnergyModel::spring || touchable.has_tangent_planes()) return Kind::plane;
    return energy == haptics::EnergyModel::weight ? Kind::slope : Kind::force;
  }

  VirtualLink<device::RemoteReading> up_;
  VirtualLink<device::LocalSurface> down_;
  device::Traits traits_;
  SharedTextures textures_;
  std::shared_ptr<device::SharedExchange> shared_ = std::make_shared<device::SharedExchange>();
  std::shared_ptr<device::RemoteExchange> remote_ = std::make_shared<device::RemoteExchange>();
  double t_s_ = 0.0;
  Ring<haptics::TouchEvent> events_{1024};
  Ring<haptics::TouchEvent> far_events_{1024};
  std::unique_ptr<device::SharedDevice> host_;
  haptics::HapticScene local_;
  std::unique_ptr<haptics::TickPipeline> near_;
  std::unique_ptr<device::RemoteDevice> client_;
  haptics::HapticScene far_scene_;
  std::unique_ptr<haptics::TickPipeline> far_;
  haptics::TouchSample far_sample_;
};

}  // namespace palpable::session
