// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/share/share_device.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/device/remote/remote_host.hpp"
#include "palpable/device/remote/shared_device.hpp"
#include "palpable/device/url.hpp"
#include "palpable/haptics/law/local_touch.hpp"
#include "palpable/haptics/servo/reopening_loop.hpp"
#include "palpable/session/share/shared_limits.hpp"
#include "palpable/session/share/shared_textures.hpp"
#include "palpable/session/touch/outage.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace palpable::session {
namespace {

using SharedKind = device::LocalSurface::Kind;

haptics::HapticScene scene_of(SharedKind kind, const std::shared_ptr<const device::CurrentSurface>& current,
                              const SharedTextures& textures) {
  haptics::HapticScene scene;
  scene.touchable = std::make_shared<const haptics::LocalTouch>(kind, current, textures.textures());
  scene.id = static_cast<std::uint32_t>(kind);
  return scene;
}

/// Follows a loop: changes its law to the kind of surface and the textures that come, and tells what happens
/// to the device.
class Follower {
 public:
  Follower(haptics::ReopeningLoop& loop, const device::SharedExchange& exchange,
           std::shared_ptr<const device::CurrentSurface> current, const SharedTextures& textures)
      : loop_(loop), exchange_(exchange), current_(std::move(current)), textures_(textures) {}

  void look(const std::function<void(const std::string&)>& tell, double now_s) {
    const std::pair wanted{exchange_.kind.load(std::memory_order_relaxed), textures_.version()};
    if (std::exchange(rendered_, wanted) != wanted) loop_.change(scene_of(wanted.first, current_, textures_));
    using Event = haptics::TouchEvent::Kind;
    while (const auto event = loop_.take_event()) {
      const bool is_device =
          event->kind == Event::fault && event->value == static_cast<std::uint32_t>(device::Status::fault);
      if (is_device && device_.begin()) tell("The device has failed: " + loop_.device_fault() + ".");
      const bool is_off = event->kind == Event::fault &&
                          event->value == static_cast<std::uint32_t>(device::Status::stale) &&
                          exchange_.connected.load(std::memory_order_relaxed);
      if (is_off && surfaces_.begin())
        tell("The force is off: the other computer is paused, or sends nothing in time.");
      if (event->kind == Event::recovered) {
        surfaces_.note_works(now_s);
        device_.note_works(now_s);
      }
      if (event->kind == Event::not_finite) tell("The force is off: the surface gave an invalid value.");
      if (event->kind == Event::motors_warm) tell("The motors are warm: the greatest force is reduced.");
    }
    if (surfaces_.take_end(now_s)) tell("The other computer sends again.");
    if (device_.take_end(now_s)) tell("The device answers again.");
    if (std::string guidance = loop_.device_guidance(); guidance != guidance_) {
      guidance_ = std::move(guidance);
      if (!guidance_.empty()) tell(guidance_ + ".");
    }
  }

 private:
  haptics::ReopeningLoop& loop_;
  const device::SharedExchange& exchange_;
  std::shared_ptr<const device::CurrentSurface> current_;
  const SharedTextures& textures_;
  /// The kind of surface, and the version of the textures.
  std::pair<SharedKind, std::uint32_t> rendered_{SharedKind::plane, 0};
  Outage device_;
  Outage surfaces_;
  std::string guidance_;
};

}  // namespace

Result<haptics::ServoStatistics> share_device(const ShareOptions& options, const Work& work) {
  device::OpenOptions open;
  open.seed = options.seed;
  open.rate_hz = options.servo.rate_hz;
  auto opened = device::open_device(options.device_url, open);
  if (!opened) return std::move(opened).error();
  const device::Traits traits = (*opened)->traits();
  if (!traits.pushes_back)
    return Error{ErrorCode::usage, "a device without motors needs no sharing",
                 device::url_as_place(options.device_url)};
  if (traits.has_torque) options.on_news("This device's torques are not used: only forces are shared.");
  auto exchange = std::make_shared<device::SharedExchange>();
  const auto current = std::make_shared<device::CurrentSurface>();
  const auto shared = [exchange, current](std::unique_ptr<device::Device> device) {
    return std::unique_ptr<device::Device>(
        std::make_unique<device::SharedDevice>(std::move(device), exchange, current, device::shared_clock_s));
  };
  haptics::ReopeningLoop::Open reopen;
  if (const auto again = device::reopener(options.device_url, options.servo.rate_hz))
    reopen = [again, shared]() -> Result<std::unique_ptr<device::Device>> {
      auto device = again();
      if (!device) return std::move(device).error();
      return shared(*std::move(device));
    };
  SharedTextures textures;
  auto loop = haptics::ReopeningLoop::start(shared(*std::move(opened)),
                                            scene_of(SharedKind::plane, current, textures),
                                            shared_servo(options.servo), reopen);
  if (!loop) return std::move(loop).error();

  std::mutex telling;
  const auto tell = [&](const std::string& sentence) {
    const std::lock_guard lock(telling);
    options.on_news(sentence);
  };
  device::HostOptions host_options;
  host_options.address = options.address;
  host_options.port = options.port;
  host_options.traits = traits;
  host_options.limited = [&](const device::LocalSurface& surface) {
    return limited_surface(surface, traits, options.servo.rate_hz, options.hand_damping_Ns_per_m,
                           textures.stiffening(surface.texture.number));
  };
  host_options.on_texture = [&textures](const device::LocalTexture& texture) {
    return textures.put(texture);
  };
  host_options.on_news = tell;
  auto host = device::RemoteHost::open(std::move(host_options), exchange);
  if (!host) return std::move(host).error();
  Follower follower(**loop, *exchange, current, textures);
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  std::string token;
  while (!work.cancelled() && std::chrono::duration<double>(Clock::now() - begun).count() < options.seconds) {
    if (std::string newest = (*host)->token(); newest != token) {
      token = std::move(newest);
      const std::lock_guard lock(telling);
      options.on_address((*host)->port(), token);
    }
    follower.look(tell, device::shared_clock_s());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  host->reset();
  (*loop)->stop();
  return (*loop)->statistics();
}

}  // namespace palpable::session
