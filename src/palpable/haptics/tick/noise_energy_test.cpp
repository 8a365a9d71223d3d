// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The energy that `proxy` returns on white noise, by the hands' true movements and by the account. A fast
// hand crosses a bump in a tick or two and is on its far side before any force acted.
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/tick/energy_touch.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// 30 hands on each surface by default; PALPABLE_TOUCHES=500 for a measurement.
int hands_of_each() {
  const char* wanted = std::getenv("PALPABLE_TOUCHES");
  return wanted != nullptr ? std::atoi(wanted) : 30;
}

struct Noise {
  double steepest = 3.0;
  double friction = 0.0;
};

models::Scene noise(unsigned seed, double steepest) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0.0F, 1.0F);
  Raster<float> z(200, 160, 0.005F);
  for (float& height : z.values()) height += 0.001F * share(random);
  models::limit_slope(z, kPixel_m, steepest);
  return scene_of(std::move(z));
}

/// A hand that explores noise for ten seconds, without the controller.
TouchedEnergy energy_on(const Noise& surface, const device::HandOptions& options, unsigned seed) {
  return touched_energy(options, [&](const SafeContact& safe) {
    LawParameters parameters;
    parameters.law = Law::proxy;
    parameters.stiffness_N_per_m = safe.stiffness_N_per_m;
    parameters.damping_Ns_per_m = safe.damping_Ns_per_m;
    parameters.static_friction = surface.friction;
    return made(noise(seed, surface.steepest), parameters);
  });
}

class EnergyOnNoise : public testing::TestWithParam<Noise> {};

TEST_P(EnergyOnNoise, IsNotMadeAndReportedAsItIs) {
  Hands hands(71);
  double contact = 0.0;
  for (unsigned k = 1; k <= static_cast<unsigned>(hands_of_each()); ++k) {
    const TouchedEnergy energy = energy_on(GetParam(), loose_hand(hands, k), k);
    EXPECT_LE(energy.contact_J, 1e-6) << "hand " << k;
    EXPECT_LE(energy.contact_J, energy.said_J + 1e-6) << "hand " << k;
    // An earlier version left the proxy in a pit while the hand went on, and reported up to 1 mJ.
    EXPECT_LE(energy.said_J, 3e-5) << "hand " << k;
    contact += energy.contact_share / hands_of_each();
  }
  EXPECT_GT(contact, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, EnergyOnNoise,
                         testing::Values(Noise{3.0, 0.0}, Noise{3.0, 0.3}, Noise{100.0, 0.0},
                                         Noise{100.0, 0.3}),
                         [](const auto& surface) {
                           return "slope_" + std::to_string(static_cast<int>(surface.param.steepest)) +
                                  "_friction_" +
                                  std::to_string(static_cast<int>(100.0 * surface.param.friction));
                         });

}  // namespace
}  // namespace palpable::haptics
