// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The energy that `proxy` returns on solids with creases, by the hands' true movements and by the account.
#include "palpable/haptics/law/field_proxy.hpp"
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/random_solid.hpp"
#include "palpable/haptics/tick/energy_touch.hpp"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace palpable::haptics {

/// It is not in an unnamed namespace, so that it is found.
inline void read_pages(const RandomSolid&) noexcept {}

namespace {

/// A hand that explores a random solid for ten seconds, without the controller.
TouchedEnergy energy_on_a_solid(const device::HandOptions& options, double friction, unsigned seed) {
  using Law = FieldProxyLaw<RandomSolid>;
  return touched_energy(options, [&](const SafeContact& safe) {
    return std::make_shared<const LawTouchable<Law>>(
        Law(std::make_shared<const RandomSolid>(seed),
            MaterialMap({safe.stiffness_N_per_m, safe.damping_Ns_per_m, friction, friction * 5.0 / 6.0}),
            0.0),
        1);
  });
}

class EnergyOnRandomSolids : public testing::TestWithParam<double> {};

TEST_P(EnergyOnRandomSolids, IsNotMadeAndNotReportedTooLow) {
  Hands hands(1);
  double contact = 0.0;
  constexpr int kHands = 16;
  for (unsigned k = 1; k <= kHands; ++k) {
    device::HandOptions options = hands.next();
    options.resolution_m = hands.uniform(1e-6, 2e-5);
    options.script.kind = device::HandScriptOptions::Kind::random;
    options.script.workspace_m = {0.04, 0.03, 0.03};
    options.script.seed = k;
    options.script.speed_m_per_s = hands.uniform(0.03, 0.3);
    options.script.press_N = hands.uniform(0.3, 3.0);
    const TouchedEnergy energy = energy_on_a_solid(options, GetParam(), k);
    EXPECT_LE(energy.contact_J, 1e-6) << "hand " << k;
    EXPECT_LE(energy.interval_J, 1e-6) << "hand " << k;
    EXPECT_LE(energy.interval_J, energy.said_J + 1e-6) << "hand " << k;
    contact += energy.contact_share / kHands;
  }
  EXPECT_GT(contact, 0.3);
}

/// Fast hands without friction that got 18 uJ in a contact (the 61st) and up to 34 uJ within one, before the
/// return limit held in long contacts.
TEST(EnergyOnARandomSolid, IsNotMadeByHandsThatSlipOffADeepSpring) {
  Hands hands(71);
  for (unsigned k = 1; k <= 61; ++k) {
    device::HandOptions options = loose_hand(hands, k, 0.8);
    options.resolution_m = 1e-6 * std::pow(50.0, (options.resolution_m - 1e-6) / 1.9e-5);
    if (k != 4 && k != 31 && k != 61) continue;
    EXPECT_LE(energy_on_a_solid(options, 0.0, k).interval_J, 1e-6) << "hand " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, EnergyOnRandomSolids, testing::Values(0.0, 0.2, 0.5),
                         [](const auto& friction) {
                           return std::to_string(static_cast<int>(100.0 * friction.param)) + "_percent";
                         });

}  // namespace
}  // namespace palpable::haptics
