// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/share/share_device.hpp"

#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/session/share/shared_limits.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/test_session.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using std::chrono::milliseconds;

/// Shares `sim:` on the loopback interface, in a thread.
class Sharing {
 public:
  Sharing() {
    options_.device_url = "sim:";
    options_.servo = unprivileged(1.0).session.servo;
    options_.on_address = [this](std::uint16_t port, const std::string& token) {
      const std::lock_guard lock(mutex_);
      url_ = "remote:127.0.0.1:" + std::to_string(port) + "?token=" + token;
    };
    options_.on_news = [](const std::string&) {};
    thread_ = std::thread([this] {
      Work work;
      work.cancel = &ended_;
      result_.emplace(share_device(options_, work));
    });
  }
  ~Sharing() { end(); }
  Sharing(const Sharing&) = delete;
  Sharing& operator=(const Sharing&) = delete;

  std::string url() {
    for (int k = 0; k < 5000; ++k) {
      {
        const std::lock_guard lock(mutex_);
        if (!url_.empty()) return url_;
      }
      std::this_thread::sleep_for(milliseconds(2));
    }
    return {};
  }
  haptics::ServoStatistics end() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    EXPECT_TRUE(result_ && *result_);
    return result_ && *result_ ? **result_ : haptics::ServoStatistics{};
  }

 private:
  ShareOptions options_;
  std::atomic<bool> ended_{false};
  std::mutex mutex_;
  std::string url_;
  std::optional<Result<haptics::ServoStatistics>> result_;
  std::thread thread_;
};

TEST(ShareDevice, IsTouchedWithOverTheLoopbackInterface) {
  Sharing sharing;
  const std::string url = sharing.url();
  auto device = device::open_device(url, {});
  ASSERT_TRUE(device) << device.error().sentence();
  const device::Traits traits = (*device)->traits();
  const models::Scene scene = hilly_scene(0.004);
  KeptSurfaces kept;
  auto prepared =
      prepare_scene(scene, TouchSettings{}, traits, 1000.0, haptics::fit_workspace(scene, traits), kept);
  ASSERT_TRUE(prepared);
  {
    auto loop =
        haptics::ServoLoop::start(*std::move(device), prepared->scene, unprivileged(1.0).session.servo);
    ASSERT_TRUE(loop) << loop.error().sentence();
    std::this_thread::sleep_for(milliseconds(4000));
    (*loop)->stop();
    EXPECT_GT((*loop)->statistics().touch.contact_ticks, 100U);
    EXPECT_EQ((*loop)->statistics().allocations_in_ticks, 0U);
  }
  const haptics::ServoStatistics here = sharing.end();
  EXPECT_GT(here.touch.contact_ticks, 100U);
  EXPECT_GT(here.touch.max_force_N, 0.1);
  EXPECT_LE(here.touch.made_max_J, 1e-3);
  EXPECT_EQ(here.allocations_in_ticks, 0U);
}

TEST(ShareDevice, IsTouchedByGroovesWhereTracingWasAskedFor) {
  Sharing sharing;
  Raster<models::BoundaryPixel> edges(100, 80);
  for (int x = 10; x < 90; ++x) edges(x, 40) = {1.0F, 0.0F};
  models::Scene scene;
  scene.model = std::make_shared<const models::Contours>(
      models::Contours{*models::BoundaryMap::from_edges(std::move(edges), 0.001, 2.0, {}, Work{}),
                       models::relief_of(hilly_scene(0.004))});
  TouchSettings settings;
  settings.law.law = haptics::Law::tracing;
  settings.law_is_chosen = true;
  const auto lines = std::make_shared<const models::Scene>(std::move(scene));
  const auto session = TouchSession::open(lines, settings, sharing.url(), unprivileged(1.0).session);
  ASSERT_TRUE(session) << session.error().sentence();
  std::string said;
  for (const std::string& notice : (*session)->notices()) said += notice;
  EXPECT_NE(said.find("would come late: the law is groove."), std::string::npos) << said;
}

TEST(ShareDevice, LimitsWhatASurfaceAsksFor) {
  device::Traits traits;
  traits.mass_kg = 0.1;
  traits.damping_Ns_per_m = 0.1;
  traits.coulomb_friction_N = 0.05;
  traits.position_resolution_m = 1e-5;
  device::LocalSurface surface;
  surface.kind = device::LocalSurface::Kind::plane;
  surface.normal.v = {0.0, 0.0, 1.0};
  surface.stiffness_N_per_m = 1e6;
  const auto limited = limited_surface(surface, traits, 1000.0, haptics::kLeastHandDamping_Ns_per_m);
  EXPECT_LT(limited.stiffness_N_per_m, 2000.0);
  EXPECT_GT(limited.stiffness_N_per_m, 100.0);
  EXPECT_GT(limited.damping_Ns_per_m, 0.0);
  surface.stiffness_N_per_m = 0.0;
  EXPECT_EQ(limited_surface(surface, traits, 1000.0, 1.5).kind, device::LocalSurface::Kind::free);
}

TEST(ShareDevice, LimitsVibrationsAndPulls) {
  device::Traits traits;
  device::LocalSurface surface;
  surface.kind = device::LocalSurface::Kind::free;
  surface.transient = {4.0, 100.0, 80.0};
  surface.pull_N.v = {0.0, -0.3, 0.0};
  EXPECT_EQ(limited_surface(surface, traits, 1000.0, 1.5), surface);
  // Fewer than five ticks to a period, and more than a guide may pull.
  surface.transient.frequency_hz = 300.0;
  surface.pull_N.v = {0.0, -30.0, 40.0};
  const auto limited = limited_surface(surface, traits, 1000.0, 1.5);
  EXPECT_EQ(limited.transient, device::ContactTransient{});
  EXPECT_NEAR(norm(limited.pull_N), 1.0, 1e-12);
  EXPECT_NEAR(limited.pull_N.v.z, 0.8, 1e-12);
}

TEST(ShareDevice, NeedsADeviceWithMotors) {
  ShareOptions options;
  options.device_url = "nothing:";
  EXPECT_EQ(share_device(options, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::session
