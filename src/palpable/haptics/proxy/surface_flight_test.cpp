// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/proxy/surface_flight.hpp"

#include "palpable/haptics/proxy/surface_proxy.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kTickLength_s = 0.001;

/// Walls of one pixel, 8 mm high before their slopes are limited, 8 mm or 8 pixels apart.
struct PixelWalls {
  PixelWalls(double pixel_m, double steepest_slope) {
    Raster<float> z(static_cast<int>(0.06 / pixel_m), static_cast<int>(0.04 / pixel_m));
    const int period = std::max(8, static_cast<int>(0.008 / pixel_m));
    for (int j = 0; j < z.height(); ++j)
      for (int i = period; i < z.width(); i += period) z(i, j) = 0.008F;
    wall_x_m = (2 * period - 0.5 * (z.width() - 1)) * pixel_m;
    apart_m = period * pixel_m;
    models::limit_slope(z, pixel_m, steepest_slope);
    relief = std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(z), pixel_m));
    bounded = std::make_unique<const models::BoundedRelief>(relief);
    crest_m = relief->sample(wall_x_m, 0.0).z_m;
  }
  double height_over(Vec3 p) const { return p.z - relief->sample(p.x, p.y).z_m; }

  std::shared_ptr<const models::Relief> relief;
  std::unique_ptr<const models::BoundedRelief> bounded;
  double wall_x_m = 0.0;
  double apart_m = 0.0;
  double crest_m = 0.0;
};

/// A stroke through the crest of a wall, until it is in contact or beyond the wall.
struct Crossing {
  bool is_met = false;
  /// The deepest place of the path under the surface.
  double deepest_m = 0.0;
};

Crossing cross_wall(const PixelWalls& walls, Vec3 middle, Vec3 way, double begins) {
  constexpr int kBetween = 50;
  const ProxyFollower<models::BoundedRelief> follower(*walls.bounded, {0.3, 0.25});
  const double length_m = std::min(0.003, 0.45 * walls.apart_m);
  const int ticks = static_cast<int>(length_m / norm(way));
  Crossing crossing;
  SurfaceProxy proxy;
  Vec3 last = middle - (ticks + begins) * way;
  for (int n = -ticks; n <= ticks && !crossing.is_met; ++n) {
    const Vec3 p = middle + (n - begins) * way;
    follower.follow({p}, proxy);
    crossing.is_met = proxy.holds_the_hand() || proxy.crossed_m > 0.0;
    for (int k = 0; k <= kBetween; ++k)
      crossing.deepest_m = std::max(
          crossing.deepest_m, -walls.height_over(last + (static_cast<double>(k) / kBetween) * (p - last)));
    last = p;
  }
  return crossing;
}

TEST(SurfaceFlight, FindsTheCrestOfAWallOfOnePixelBetweenTwoTicks) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit_range(0.0, 1.0);
  for (const double pixel_m : {0.0001, 0.00015625, 0.0004})
    for (const double steepest : {3.0, 10.0, 30.0, 100.0}) {
      const PixelWalls walls(pixel_m, steepest);
      int under = 0;
      for (int k = 0; k < 150; ++k) {
        const double speed_m_per_s = 2.0 * std::pow(10.0, -1.3 * unit_range(random));
        const Vec3 way = (speed_m_per_s * kTickLength_s) *
                         unit(Vec3{k % 2 == 0 ? 1.0 : -1.0, 0.8 * (2.0 * unit_range(random) - 1.0), 0.0});
        const double below_m = 0.9 * walls.crest_m * std::pow(unit_range(random), 2.0);
        const Vec3 middle{walls.wall_x_m, 0.0, walls.crest_m - below_m};
        if (walls.height_over(middle - 0.0025 * unit(way)) < 0.0) continue;
        const Crossing crossing = cross_wall(walls, middle, way, unit_range(random));
        under += crossing.deepest_m > 0.0 ? 1 : 0;
        constexpr double kIgnored_m = 2e-6;
        EXPECT_TRUE(crossing.is_met || crossing.deepest_m < kIgnored_m)
            << "pixel " << pixel_m << ", slope " << steepest << ": " << crossing.deepest_m
            << " m under the surface at " << speed_m_per_s << " m/s";
      }
      EXPECT_GT(under, 80);
    }
}

/// A relief that counts how often it is evaluated.
class CountedRelief {
 public:
  explicit CountedRelief(std::shared_ptr<const models::Relief> relief) : relief_(std::move(relief)) {}
  models::HeightSample sample(double x_m, double y_m) const noexcept {
    ++evaluations;
    return relief_.sample(x_m, y_m);
  }
  models::PairedSample paired_sample(models::Pair place_m) const noexcept {
    ++evaluations;
    return relief_.paired_sample(place_m);
  }
  models::CellPath path_in_cell(Vec3 a, Vec3 b) const noexcept { return relief_.path_in_cell(a, b); }
  models::CellWalk cell_walk(Vec3 a, Vec3 b) const noexcept { return relief_.cell_walk(a, b); }
  void prefetch(Vec3, Vec3) const noexcept {}
  void prefetch(double, double) const noexcept {}
  double steepest_slope() const noexcept { return relief_.steepest_slope(); }
  double pixel_m() const noexcept { return relief_.pixel_m(); }
  models::SurfaceBounds bounds_over(double x0_m, double y0_m, double x1_m, double y1_m) const noexcept {
    return relief_.bounds_over(x0_m, y0_m, x1_m, y1_m);
  }

  mutable int evaluations = 0;

 private:
  models::BoundedRelief relief_;
};

TEST(SurfaceFlight, IsNotEvaluatedAgainWhereItStops) {
  // A proxy on top of a wall whose hand is deep below, behind the wall: it flies down as far as a tick
  // allows.
  const PixelWalls walls(0.00015625, 100.0);
  const CountedRelief surface(walls.relief);
  const ProxyFollower<CountedRelief> follower(surface, {0.4, 0.3});
  int flights = 0;
  for (double beyond_m = 0.0003; beyond_m < 0.003; beyond_m += 0.0001) {
    const double x_m = walls.wall_x_m + 1e-5;
    const Vec3 hand{walls.wall_x_m + beyond_m, 0.0, -0.004};
    SurfaceProxy proxy;
    proxy.rest(x_m, 0.0, walls.relief->paired_sample(models::Pair{x_m, 0.0}));
    proxy.hand_m = hand;
    surface.evaluations = 0;
    follower.follow({hand}, proxy);
    flights += surface.evaluations > 3 ? 1 : 0;
    EXPECT_LE(surface.evaluations, 5) << beyond_m;
  }
  EXPECT_GT(flights, 0);
}

TEST(SurfaceProxy, RemembersThatTheHandIsBelow) {
  // A hand that rests deep in the solid, far from its proxy, which comes nearer in three steps a tick.
  const PixelWalls walls(0.00015625, 3.0);
  const CountedRelief surface(walls.relief);
  const ProxyFollower<CountedRelief> follower(surface, {0.0, 0.0});
  const Vec3 hand{walls.wall_x_m + 0.5 * walls.apart_m, 0.0, -0.003};
  SurfaceProxy proxy;
  const double x_m = hand.x - 0.003;
  proxy.rest(x_m, 0.0, walls.relief->paired_sample(models::Pair{x_m, 0.0}));
  proxy.hand_m = hand;
  for (int tick = 0; tick < 5; ++tick) {
    const double before_m = proxy.place_m.x;
    surface.evaluations = 0;
    follower.follow({hand}, proxy);
    EXPECT_GT(proxy.place_m.x, before_m) << tick;
    EXPECT_LE(surface.evaluations, tick == 0 ? 4 : 3) << tick;
  }
}

TEST(SurfaceProxy, FollowsASlowHandAsAnyOther) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const PixelWalls walls(0.0003, 3.0);
  const ProxyFollower<models::BoundedRelief> follower(*walls.bounded, {0.4, 0.3});
  int rested = 0, went_on = 0;
  for (int stroke = 0; stroke < 100; ++stroke) {
    SurfaceProxy any, slow;
    Vec3 hand{walls.wall_x_m + 0.006 * uniform(random), 0.004 * uniform(random), 0.0};
    const Vec3 way{1.5e-4 * uniform(random), 1e-4 * uniform(random), 0.0};
    const double deep_m = 0.001 * (0.8 + uniform(random));
    for (int tick = 0; tick < 50; ++tick) {
      hand += way;
      hand.z = walls.relief->sample(hand.x, hand.y).z_m - deep_m;
      follower.follow(hand, any);
      if (follower.is_held_slowly(hand, slow)) {
        SlideEnd end;
        const ProxyBefore before{slow.place_m, true, slow.hand_m};
        const bool rests = follower.follow_slowly(hand, before, slow, end);
        ++(rests ? rested : went_on);
        if (rests) {
          EXPECT_EQ(end.place_m, slow.place_m);
          EXPECT_NEAR(end.way.whole2, squared_norm(hand - slow.place_m), 1e-18);
        }
      } else {
        follower.follow(hand, slow);
      }
      ASSERT_EQ(any.place_m, slow.place_m);
      ASSERT_EQ(any.phase, slow.phase);
      ASSERT_EQ(any.slipping, slow.slipping);
    }
  }
  EXPECT_GT(rested, 1000);
  EXPECT_GT(went_on, 20);
}

TEST(SurfaceProxy, KnowsOnlyHandsBelowToBeBelow) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int known = 0;
  for (const double slope : {0.5, 3.0, 20.0}) {
    const PixelWalls walls(0.0003, slope);
    const ProxyFollower<models::BoundedRelief> follower(*walls.bounded, {0.4, 0.3});
    const double per_m = 1.0 / std::hypot(1.0, slope);
    for (int stroke = 0; stroke < 40; ++stroke) {
      SurfaceProxy proxy;
      Vec3 hand{walls.wall_x_m + 0.006 * uniform(random), 0.004 * uniform(random), 0.0};
      const Vec3 way{5e-4 * uniform(random), 2e-4 * uniform(random), 0.0};
      const double deep_m = 0.0015 * (1.0 + uniform(random));
      for (int tick = 0; tick < 30; ++tick) {
        hand += way;
        hand.z += 0.3 * (walls.relief->sample(hand.x, hand.y).z_m - deep_m - hand.z);
        follower.follow({hand}, proxy);
        if (proxy.under_m <= 0.0) continue;
        ++known;
        EXPECT_LE(walls.height_over(proxy.under_at_m), 1e-9 - proxy.under_m);
        Vec3 towards{uniform(random), uniform(random), 1.0};
        towards = 0.999 * proxy.under_m * per_m * unit(towards);
        EXPECT_LT(walls.height_over(proxy.under_at_m + towards), 0.0);
      }
    }
  }
  EXPECT_GT(known, 500);
}

}  // namespace
}  // namespace palpable::haptics
