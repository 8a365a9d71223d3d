// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Implements a force law: a Touchable. This one pulls the hand to the highest point, like a magnet.
#include <chrono>
#include <cstdio>
#include <thread>

#include <palpable/palpable.hpp>

using namespace palpable;

class Magnet final : public haptics::Touchable {
 public:
  Magnet(Point<SceneFrame> place, double stiffness_N_per_m, double damping_Ns_per_m)
      : place_(place), stiffness_N_per_m_(stiffness_N_per_m), damping_Ns_per_m_(damping_Ns_per_m) {}

  haptics::LawOutput evaluate(const haptics::Hand& hand, haptics::TouchState&) const noexcept override {
    const Vector<SceneFrame> to_place = place_ - hand.position;
    haptics::LawOutput output;
    output.contact = true;
    output.spring_N = stiffness_N_per_m_ * to_place;
    output.force_N = output.spring_N - damping_Ns_per_m_ * hand.velocity_m_per_s;
    // With the energy stored in the spring, which energy_model() explains, the passivity observer can
    // distinguish returned energy from generated energy.
    output.stored_J = 0.5 * stiffness_N_per_m_ * dot(to_place.v, to_place.v);
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 1; }
  // The magnet pulls everywhere: its energy is a potential, as that of a weight, not that of a contact.
  haptics::EnergyModel energy_model() const noexcept override { return haptics::EnergyModel::weight; }
  double damping_Ns_per_m() const noexcept override { return damping_Ns_per_m_; }
  void touch_pages() const noexcept override {}

 private:
  Point<SceneFrame> place_;
  double stiffness_N_per_m_, damping_Ns_per_m_;
};

int main() {
  Raster<float> height_m(101, 101, 0.0F);
  height_m(70, 50) = 0.010F;
  auto relief = models::Relief::from_samples(std::move(height_m), 0.001);
  if (!relief) return std::puts(relief.error().sentence().c_str()), 1;
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*std::move(relief));
  auto device = device::open_device("sim:", {});
  if (!device) return std::puts(device.error().sentence().c_str()), 1;
  const auto magnet = std::make_shared<const Magnet>(Point<SceneFrame>{{0.02, 0.0, 0.01}}, 50.0, 1.0);
  auto loop = haptics::start_touch(scene, magnet, std::move(*device));
  if (!loop) return std::puts(loop.error().sentence().c_str()), 1;
  while ((*loop)->statistics().touch.ticks < 1000) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  (*loop)->stop();
  const auto counts = (*loop)->statistics().touch;
  std::printf("The magnet pulled with up to %.2f N\n", counts.max_force_N);
  return counts.max_force_N > 0.1 ? 0 : 1;
}
