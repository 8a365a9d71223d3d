// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Touches a height field through two functions: a program passes the position of the hand and receives the
// force.
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <palpable/palpable.hpp>

using namespace palpable;

int main() {
  // A cone, 15 mm high on a plate of 100 mm.
  Raster<float> height_m(201, 201);
  for (int y = 0; y < 201; ++y)
    for (int x = 0; x < 201; ++x)
      height_m(x, y) =
          static_cast<float>(0.015 * std::max(0.0, 1.0 - std::hypot(x - 100.0, y - 100.0) / 100.0));
  auto cone = models::Relief::from_samples(std::move(height_m), 0.0005);
  if (!cone) return std::puts(cone.error().sentence().c_str()), 1;
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*std::move(cone));

  // The hand sinks from 20 mm above the workspace's middle to 10 mm below it within half a second.
  std::atomic<double> most_N = 0.0;
  double z_m = 0.02;
  auto device = std::make_unique<device::CallbackDevice>(
      device::Traits{.name = "my hand"},
      [&z_m] {
        z_m = std::max(-0.01, z_m - 0.00006);
        return device::Reading{{{0.01, 0.0, z_m}}};
      },
      [&most_N](Vector<DeviceFrame> force_N) { most_N = std::max(most_N.load(), force_N.v.z); });
  auto loop = haptics::start_touch(scene, {.stiffness_N_per_m = 300.0}, std::move(device));
  if (!loop) return std::puts(loop.error().sentence().c_str()), 1;
  while ((*loop)->statistics().touch.ticks < 1500) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  (*loop)->stop();
  std::printf("The cone pushed back with up to %.2f N\n", most_N.load());
  return most_N > 0.1 ? 0 : 1;
}
