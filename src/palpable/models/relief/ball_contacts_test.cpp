// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/ball_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

/// Height of the centre of a ball on the sample that `contact` names.
double centre_on(const Raster<float>& heights, double reach, Pixel at, ContactOffset contact) {
  const double rise2 = reach * reach - contact.right * contact.right - contact.down * contact.down;
  EXPECT_GE(rise2, 0.0);
  return static_cast<double>(heights(at.x + contact.right, at.y + contact.down)) + std::sqrt(rise2);
}

double highest_centre(const Raster<float>& heights, double reach, Pixel at) {
  double highest = -1e30;
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x) {
      const double rise2 = reach * reach - (x - at.x) * (x - at.x) - (y - at.y) * (y - at.y);
      if (rise2 >= 0.0) highest = std::max(highest, static_cast<double>(heights(x, y)) + std::sqrt(rise2));
    }
  return highest;
}

TEST(BallContacts, AreTheHighestOfAllForSmallAndLargeBalls) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> height(0.0F, 40.0F);
  Raster<float> heights(67, 41);
  for (float& z : heights.values()) z = height(random);
  for (const double reach : {0.5, 3.2, 23.9, 24.0, 31.7, 500.0}) {
    const BallContacts contacts(heights, reach);
    std::vector<ContactOffset> found(67);
    for (int y = 0; y < heights.height(); ++y) {
      contacts.find_row(y, found);
      for (int x = 0; x < heights.width(); ++x)
        ASSERT_NEAR(centre_on(heights, reach, {x, y}, found[static_cast<std::size_t>(x)]),
                    highest_centre(heights, reach, {x, y}), 1e-4)
            << reach << " at " << x << ", " << y;
    }
  }
}

TEST(BallContacts, OfABallMuchLargerThanTheSamplesAreFound) {
  Raster<float> heights(3, 2);
  heights(2, 1) = 5.0F;
  std::vector<ContactOffset> found(3);
  BallContacts(heights, 1e9).find_row(0, found);
  EXPECT_EQ(found[0].right, 2);
  EXPECT_EQ(found[0].down, 1);
}

}  // namespace
}  // namespace palpable::models
