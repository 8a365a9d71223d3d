// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How the computed stiffness limit compares with the stiffness at which simulated hands on random devices
// get more energy back than they gave: palpable_stiffness_set [--devices N] [--seed N] [--seconds N]
// [--slowest-sensor-ms MS].
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/haptics/tick/test_tapping_hand.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

struct Arguments {
  int devices = 200;
  double seconds = 30.0;
  std::uint64_t seed = 1;
  /// Sensors of 1 ms to this; 0 = a new position in each tick.
  double slowest_sensor_ms = 0.0;
};

constexpr double kAllowed_J = 1e-6;

/// The least share of the limit, from 0.8 to 3 in steps of 1 %, at which the hand receives more than 1 µJ.
double true_share(const device::HandOptions& hand, const haptics::SafeContact& wall,
                  const Arguments& arguments, std::uint64_t seed) {
  constexpr double kLeast = 0.8, kMost = 3.0, kStep = 0.01;
  for (double share = kLeast; share < kMost; share += kStep)
    if (haptics::most_received_J(hand, share * wall.stiffness_N_per_m, wall.damping_Ns_per_m,
                                 arguments.seconds, seed) > kAllowed_J)
      return share;
  return kMost;
}

void run(const Arguments& arguments) {
  std::mt19937_64 random(arguments.seed);
  std::vector<double> shares;
  double most_at_limit_J = 0.0;
  int above = 0;
  for (int n = 0; n < arguments.devices; ++n) {
    const auto hand = haptics::random_device(random, 1e-3 * arguments.slowest_sensor_ms);
    const std::uint64_t seed = random();
    const auto wall = haptics::stiffest_wall(hand);
    const double received_J = haptics::most_received_J(hand, wall.stiffness_N_per_m, wall.damping_Ns_per_m,
                                                       arguments.seconds, seed);
    most_at_limit_J = std::max(most_at_limit_J, received_J);
    above += received_J > kAllowed_J ? 1 : 0;
    shares.push_back(true_share(hand, wall, arguments, seed));
    fmt::print(
        "{:4} {:.3f} kg, {:.2f} N·s/m, {:3.0f} N/m, {:4.1f} µm, {:4.1f} ms, delay {}: limit {:5.0f} N/m, "
        "true {:.2f} of it, {:.2f} µJ at it\n",
        n, hand.device_mass_kg, hand.device_damping_Ns_per_m, hand.arm_stiffness_N_per_m,
        1e6 * hand.resolution_m, 1e3 * hand.sensor_period_s, hand.delay_samples, wall.stiffness_N_per_m,
        shares.back(), 1e6 * received_J);
  }
  fmt::print(
      "true limit over the computed one: least {:.2f}, 5 % {:.2f}, median {:.2f}, 95 % {:.2f}, most {:.2f}; "
      "{} of {} devices get more than 1 µJ at the limit, at most {:.2f} µJ\n",
      quantile_of(shares, 0.0), quantile_of(shares, 0.05), quantile_of(shares, 0.5),
      quantile_of(shares, 0.95), quantile_of(shares, 1.0), above, arguments.devices, 1e6 * most_at_limit_J);
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** values) {
  palpable::bench::Arguments arguments;
  for (int i = 1; i + 1 < count; i += 2) {
    const double value = palpable::finite_number(values[i + 1]).value_or(0.0);
    if (std::strcmp(values[i], "--devices") == 0) arguments.devices = static_cast<int>(value);
    if (std::strcmp(values[i], "--seed") == 0) arguments.seed = static_cast<std::uint64_t>(value);
    if (std::strcmp(values[i], "--seconds") == 0) arguments.seconds = value;
    if (std::strcmp(values[i], "--slowest-sensor-ms") == 0) arguments.slowest_sensor_ms = value;
  }
  if (count % 2 == 0 || arguments.devices < 1 || !(arguments.seconds > 0.0)) {
    fmt::print(stderr,
               "palpable_stiffness_set [--devices N] [--seed N] [--seconds N] [--slowest-sensor-ms MS]\n");
    return 2;
  }
  palpable::bench::run(arguments);
  return 0;
}
