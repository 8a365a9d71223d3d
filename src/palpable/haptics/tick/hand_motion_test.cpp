// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/hand_motion.hpp"

#include "palpable/haptics/tick/test_loop.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kSpeed_m_per_s = 0.06;

/// A hand that goes down into a damped surface while only every `every`th position arrives.
std::vector<Vec3> forces_of_sparse_readings(int every, std::vector<double>& speeds) {
  Loop loop(std::make_shared<SpringSurface>(flat, 200.0, 4.0));
  for (int n = 0; n < 120; ++n) {
    device::Reading& reading = loop.device.reading;
    reading.is_repeated = n % every != 0;
    if (!reading.is_repeated) reading.position.v.z = 0.002 - kSpeed_m_per_s * kT_s * n;
    speeds.push_back(loop.run(1).velocity_m_per_s.v.z);
  }
  return loop.device.written;
}

TEST(HandMotion, IsNotFasterWherePositionsAreLost) {
  for (const int every : {1, 2, 5}) {
    std::vector<double> speeds;
    const auto forces = forces_of_sparse_readings(every, speeds);
    for (std::size_t n = 20; n < speeds.size(); ++n)
      ASSERT_NEAR(speeds[n], -kSpeed_m_per_s, 1e-9) << every << ", tick " << n;
    // The spring's steps are those of the positions; the damper's force makes none.
    for (std::size_t n = 60; n < forces.size(); ++n)
      ASSERT_LE(std::abs(forces[n].z - forces[n - 1].z), 200.0 * kSpeed_m_per_s * kT_s * every + 1e-9)
          << every << ", tick " << n;
  }
}

}  // namespace
}  // namespace palpable::haptics
