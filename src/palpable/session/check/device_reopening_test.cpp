// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Each driver is unplugged from its own virtual device while it presses, and plugged in again.
#include "palpable/haptics/servo/reopening_loop.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/session/check/driver_bench.hpp"
#include "palpable/session/touch/haptic_scene.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

/// A device below which a fault happens in the servo's own thread, as the virtual devices of libraries need.
class FaultyDevice final : public device::Device {
 public:
  FaultyDevice(std::unique_ptr<device::Device> device, std::shared_ptr<const std::atomic<bool>> unplugged,
               const DriverBench& bench)
      : device_(std::move(device)), unplugged_(std::move(unplugged)), bench_(bench) {}
  const device::Traits& traits() const noexcept override { return device_->traits(); }
  device::Reading read() noexcept override {
    if (*unplugged_ && !std::exchange(is_unplugged_, true)) bench_.inject(DriverFault::unplugged);
    return device_->read();
  }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    device_->write(force_N);
    if (!bench_.is_real_time) bench_.pass_tick();
  }
  void stop() noexcept override { device_->stop(); }
  void cut_force() noexcept override { device_->cut_force(); }
  std::string fault() const override { return device_->fault(); }
  std::string guidance() const override { return device_->guidance(); }

 private:
  std::unique_ptr<device::Device> device_;
  std::shared_ptr<const std::atomic<bool>> unplugged_;
  const DriverBench& bench_;
  bool is_unplugged_ = false;
};

constexpr double kPushes_N = 0.03;

struct ReopenedCase {
  const char* name;
  DriverBench (*bench)(const OnForce&);
  double press_m;
  /// The virtual device moves on while it is unplugged: its hand is lifted, so that it does not sink in.
  bool moves_on = false;
};

template <class Condition>
bool happens(Condition&& condition) {
  using Clock = std::chrono::steady_clock;
  for (const auto until = Clock::now() + std::chrono::seconds(20); Clock::now() < until;
       std::this_thread::sleep_for(std::chrono::milliseconds(2)))
    if (condition()) return true;
  return false;
}

class ReopenedDriver : public testing::TestWithParam<ReopenedCase> {
 protected:
  Result<std::unique_ptr<device::Device>> open() {
    ++tries_;
    // Plugged in before this try, by its thread.
    if (plugs_in_.exchange(false)) {
      bench_.inject(DriverFault::none);
      *unplugged_ = false;
      newest_N_ = 0.0;
      const std::lock_guard lock(mutex_);
      after_N_.clear();
    }
    auto device = bench_.open();
    if (!device) return device;
    bench_.pull_to(goal_m_);
    return std::unique_ptr<device::Device>(
        std::make_unique<FaultyDevice>(*std::move(device), unplugged_, bench_));
  }
  void note(Vec3 force_N) {
    newest_N_ = norm(force_N);
    const std::lock_guard lock(mutex_);
    after_N_.push_back(norm(force_N));
  }

  std::shared_ptr<std::atomic<bool>> unplugged_ = std::make_shared<std::atomic<bool>>(false);
  std::atomic<bool> plugs_in_{false};
  std::atomic<int> tries_{0};
  std::atomic<double> newest_N_{0.0};
  std::mutex mutex_;
  /// What reached the device since it was plugged in.
  std::vector<double> after_N_;
  Vec3 goal_m_;
  DriverBench bench_ = GetParam().bench([this](Vec3 force_N) { note(force_N); });
};

TEST_P(ReopenedDriver, ResumesWithARampInContact) {
  auto first = open();
  ASSERT_TRUE(first) << first.error().sentence();
  const device::Traits traits = (*first)->traits();
  const models::Scene scene = hilly_scene(0.004);
  const auto place = haptics::fit_workspace(scene, traits);
  KeptSurfaces kept;
  auto prepared = prepare_scene(scene, TouchSettings{}, traits, 1000.0, place, kept);
  ASSERT_TRUE(prepared);
  if (GetParam().press_m > 0.0)
    goal_m_.z = (place.inverse() * Point<SceneFrame>{{0.0, 0.0, 0.004}}).v.z - GetParam().press_m;
  bench_.pull_to(goal_m_);
  auto started = haptics::ReopeningLoop::start(*std::move(first), prepared->scene,
                                               unprivileged(1.0).session.servo, [this] { return open(); });
  ASSERT_TRUE(started) << started.error().sentence();
  haptics::ReopeningLoop& loop = **started;
  ASSERT_TRUE(happens([&] { return newest_N_ > kPushes_N; }));

  *unplugged_ = true;
  if (GetParam().moves_on) bench_.pull_to({0.0, 0.0, 0.5 * traits.workspace_m.z});
  // Tried in vain at least once.
  ASSERT_TRUE(happens([&] { return tries_ >= 2; }));
  EXPECT_FALSE(loop.device_fault().empty());
  EXPECT_FALSE(loop.device_guidance().empty());

  plugs_in_ = true;
  ASSERT_TRUE(happens([&] { return !plugs_in_ && newest_N_ > kPushes_N; })) << loop.device_fault();
  EXPECT_GE(loop.reopened(), 1);
  loop.stop();
  EXPECT_EQ(loop.device_fault().find("another one"), std::string::npos);
  const std::lock_guard lock(mutex_);
  // No force of before, and none at once: at least 10 ms of the ramp of 250 ms.
  std::size_t weak = 0;
  while (weak < after_N_.size() && after_N_[weak] < 0.1 * traits.max_force_N) ++weak;
  EXPECT_GE(weak, 3U);
  EXPECT_LT(after_N_.front(), 0.01 * traits.max_force_N);
}

INSTANTIATE_TEST_SUITE_P(Drivers, ReopenedDriver,
                         testing::Values(ReopenedCase{"two_diy", two_diy_bench, 0.0},
                                         ReopenedCase{"inverse3", inverse3_bench, 0.012},
                                         ReopenedCase{"falcon", falcon_bench, 0.012},
                                         ReopenedCase{"force_dimension", force_dimension_bench, 0.012},
                                         ReopenedCase{"open_haptics",
                                                      [](const OnForce& on_force) {
                                                        return open_haptics_bench(on_force,
                                                                                  Callbacks::by_thread);
                                                      },
                                                      0.012, true},
                                         ReopenedCase{"evdev", evdev_bench, 0.0}),
                         [](const testing::TestParamInfo<ReopenedCase>& tested) {
                           return std::string(tested.param.name);
                         });

}  // namespace
}  // namespace palpable::session
