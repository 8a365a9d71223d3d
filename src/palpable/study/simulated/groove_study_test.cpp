// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/groove_study.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

TEST(GrooveStudy, FindsThatThePenaltyLawVibratesAndTheProxyRests) {
  GrooveStudyOptions options;
  options.hand.device_mass_kg = 0.05;
  options.hand.arm_mass_kg = 0.1;
  options.hand.arm_damping_Ns_per_m = 3.0;
  options.hand.arm_stiffness_N_per_m = 300.0;
  options.hand.max_force_N = 10.0;
  options.stiffnesses_N_per_m = {400.0, 800.0};
  for (const int delay : {1, 2})
    for (const double resolution_m : {10e-6, 40e-6}) {
      options.hand.delay_samples = delay;
      options.hand.resolution_m = resolution_m;
      const auto results = study_groove(options);
      ASSERT_TRUE(results);
      ASSERT_EQ(results->size(), 8U);
      for (const GrooveResult& r : *results) {
        if (r.law == "proxy") {
          EXPECT_LE(std::max(r.across_m, r.height_m), std::max(10e-6, resolution_m)) << r.stiffness_N_per_m;
        }
        if (r.law == "naive") {
          EXPECT_GT(r.across_m, 100e-6) << r.stiffness_N_per_m;
          EXPECT_GT(r.turns_per_s, 10.0);
        }
      }
    }
}

}  // namespace
}  // namespace palpable::study
