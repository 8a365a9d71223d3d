// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_candidates.hpp"

#include "palpable/vision/stereo/planes/plain_picture.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kCandidatesWidth = 90;
constexpr int kCandidatesHeight = 40;

/// One exact plane over a picture of one colour: all candidates lie on it.
struct OnePlane {
  PlaneMap map{kCandidatesWidth, kCandidatesHeight};
  Raster<float> trust{kCandidatesWidth, kCandidatesHeight, 1.0F};
  Regions regions{Raster<std::int32_t>(kCandidatesWidth, kCandidatesHeight, 0),
                  {kCandidatesWidth * kCandidatesHeight}};

  OnePlane() {
    for (int y = 0; y < kCandidatesHeight; ++y)
      for (int x = 0; x < kCandidatesWidth; ++x) {
        map.disparity(x, y) = truth(x, y);
        map.slope_x(x, y) = 0.1F;
        map.slope_y(x, y) = -0.05F;
      }
  }
  static float truth(int x, int y) {
    return 5.0F + 0.1F * static_cast<float>(x) - 0.05F * static_cast<float>(y);
  }
};

TEST(PlaneCandidates, OfOnePlaneEqualItExceptForRandomChanges) {
  const OnePlane scene;
  PlaneProposalOptions options;
  options.fit.ridge_px2 = 0.0F;
  PlaneCandidates candidates(kCandidatesWidth, kCandidatesHeight);
  propose_planes(plain_picture(kCandidatesWidth, kCandidatesHeight),
                 {scene.map, scene.map, scene.trust, scene.regions}, options, 0, candidates, {});
  for (int y = 15; y < kCandidatesHeight - 15; ++y)
    for (int x = 15; x < kCandidatesWidth - 15; ++x) {
      const std::size_t at = candidates.at(x, y);
      int changed = 0;
      for (std::size_t k = at; k < at + PlaneCandidates::kCount; ++k) {
        const float off = std::fabs(candidates.disparity[k] - OnePlane::truth(x, y));
        EXPECT_LE(off, options.first_change_px + 0.01F);
        changed += off > 0.01F ? 1 : 0;
      }
      EXPECT_LE(changed, 2);
    }
}

TEST(PlaneCandidates, IncludeTheOtherViewsPlane) {
  const OnePlane scene;
  PlaneMap theirs(kCandidatesWidth, kCandidatesHeight);
  theirs.disparity = Raster<float>(kCandidatesWidth, kCandidatesHeight, NAN);
  theirs.disparity(40, 20) = 33.0F;
  PlaneCandidates candidates(kCandidatesWidth, kCandidatesHeight);
  propose_planes(plain_picture(kCandidatesWidth, kCandidatesHeight),
                 {scene.map, scene.map, scene.trust, scene.regions, &theirs}, {}, 3, candidates, {});
  const auto holds_33 = [&](int x) {
    const auto first = candidates.disparity.begin() + static_cast<std::ptrdiff_t>(candidates.at(x, 20));
    return std::find(first, first + PlaneCandidates::kCount, 33.0F) != first + PlaneCandidates::kCount;
  };
  EXPECT_TRUE(holds_33(40));
  EXPECT_FALSE(holds_33(41));
}

TEST(PlaneCandidates, HaveSmallerRandomChangesInLaterRounds) {
  const OnePlane scene;
  const auto largest_change = [&](int round) {
    PlaneCandidates candidates(kCandidatesWidth, kCandidatesHeight);
    propose_planes(plain_picture(kCandidatesWidth, kCandidatesHeight),
                   {scene.map, scene.map, scene.trust, scene.regions}, {}, round, candidates, {});
    float most = 0.0F;
    for (int x = 20; x < kCandidatesWidth - 20; ++x)
      for (std::size_t k = 0; k < PlaneCandidates::kCount; ++k)
        most = std::max(most,
                        std::fabs(candidates.disparity[candidates.at(x, 20) + k] - OnePlane::truth(x, 20)));
    return most;
  };
  EXPECT_GT(largest_change(0), 0.4F);
  EXPECT_LT(largest_change(7), 0.1F);
}

}  // namespace
}  // namespace palpable::vision
