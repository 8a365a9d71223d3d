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

/// Whether the ball would be no lower on a sample than on its neighbours, and no lower than `least`.
bool may_carry(const Raster<float>& heights, double reach, Pixel at, ContactOffset contact, double least) {
  const auto on = [&](int right, int down) {
    const double rise2 = reach * reach - right * right - down * down;
    if (rise2 < 0.0 || !heights.contains(at.x + right, at.y + down)) return -1e30;
    return static_cast<double>(heights(at.x + right, at.y + down)) + std::sqrt(rise2);
  };
  const double here = on(contact.right, contact.down);
  if (here < least) return false;
  double around = -1e30;
  for (int b = -1; b <= 1; ++b)
    for (int a = -1; a <= 1; ++a) around = std::max(around, on(contact.right + a, contact.down + b));
  return here >= around;
}

TEST(BallContacts, AreAllFoundThatMayCarryTheBall) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> height(0.0F, 6.0F);
  Raster<float> heights(67, 41);
  for (float& z : heights.values()) z = height(random);
  std::vector<ContactOffset> found;
  std::size_t most = 0;
  for (const double reach : {0.5, 3.2, 23.9, 47.9, 48.1, 100.0}) {
    const BallContacts contacts(heights, reach);
    for (int y = 0; y < heights.height(); y += 5)
      for (int x = 0; x < heights.width(); x += 3) {
        contacts.find_all(x, y, 1.0F, found);
        const double least = highest_centre(heights, reach, {x, y}) - 1.0;
        std::size_t expected = 0;
        for (int down = -y; down < heights.height() - y; ++down)
          for (int right = -x; right < heights.width() - x; ++right)
            expected += may_carry(heights, reach, {x, y}, {right, down}, least) ? 1U : 0U;
        ASSERT_EQ(found.size(), expected) << reach << " at " << x << ", " << y;
        for (const ContactOffset contact : found)
          ASSERT_TRUE(may_carry(heights, reach, {x, y}, contact, least - 1e-4)) << reach;
        most = std::max(most, found.size());
      }
  }
  EXPECT_GT(most, 3U);
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
