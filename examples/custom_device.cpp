// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Implements a device: a class with four functions. Here it is a simulated mass on which the force acts.
#include <chrono>
#include <cstdio>
#include <thread>

#include <palpable/palpable.hpp>

using namespace palpable;

/// A stylus of 100 g that falls onto the scene; its motion is damped.
class DroppedStylus final : public device::Device {
 public:
  DroppedStylus() {
    traits_.name = "dropped stylus";
    traits_.mass_kg = 0.1;
    traits_.damping_Ns_per_m = 4.0;
  }
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override {
    const double dt_s = 1.0 / traits_.rate_hz;
    const double weight_N = 0.5;
    speed_m_per_s_ +=
        dt_s * (force_N_ - weight_N - traits_.damping_Ns_per_m * speed_m_per_s_) / traits_.mass_kg;
    z_m_ += dt_s * speed_m_per_s_;
    return {{{0.0, 0.0, z_m_}}};
  }
  void write(Vector<DeviceFrame> force_N) noexcept override { force_N_ = force_N.v.z; }
  void stop() noexcept override { force_N_ = 0.0; }

 private:
  device::Traits traits_;
  double z_m_ = 0.02, speed_m_per_s_ = 0.0, force_N_ = 0.0;
};

int main() {
  auto plate = models::Relief::from_samples(Raster<float>(101, 101, 0.010F), 0.001);
  if (!plate) return std::puts(plate.error().sentence().c_str()), 1;
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*std::move(plate));
  auto loop = haptics::start_touch(scene, {.stiffness_N_per_m = 300.0}, std::make_unique<DroppedStylus>());
  if (!loop) return std::puts(loop.error().sentence().c_str()), 1;
  while ((*loop)->statistics().touch.ticks < 3000) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto sample = (*loop)->take_latest();
  (*loop)->stop();
  if (!sample) return 1;
  std::printf("The stylus rests at %.2f mm on a plate of 10 mm, held by %.2f N\n",
              1000.0 * sample->position.v.z, sample->written_force_N.v.z);
  return sample->has(haptics::flag::kContact) ? 0 : 1;
}
