// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Hands that move at random above, in and below surfaces, at up to 2 m/s. No hand may pass through a surface,
// no force may pull, and the force changes by no more than stiffness times the movement of hand and proxy.
#include "palpable/haptics/law/stroke_scenes.hpp"
#include "palpable/haptics/law/test_period.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// Closer to the surface than this, the ground truth is undecided.
constexpr double kStrokeMargin_m = 1e-6;
constexpr double kFastest_m_per_s = 2.0;
constexpr int kTicks = 100;
/// Points between two ticks at which the ground truth is sampled.
constexpr int kSamplesBetween = 250;

/// 150 touches of each kind by default; PALPABLE_TOUCHES=25000 for a measurement.
int touches() {
  const char* wanted = std::getenv("PALPABLE_TOUCHES");
  return wanted != nullptr ? std::atoi(wanted) : 150;
}

/// The box in which a hand moves.
struct Room {
  Vec3 low;
  Vec3 high;
};

struct StrokeFindings {
  int inside = 0;
  int let_through = 0;
  int pulled = 0;
  int kicked = 0;
  int sunk = 0;
  int crossed = 0;
  int pushed_in_air = 0;
};

double bounced(double place, double low, double high, double& speed) {
  if (place < low || place > high) speed = -speed;
  return std::clamp(place, low, high);
}

/// A touched model and its ground truth.
struct StrokedGround {
  std::shared_ptr<const Touchable> touchable;
  /// Height above the surface; positive outside.
  std::function<double(Vec3)> height_over;
  /// Whether the surface separates two points: no proxy may move from one to the other within a tick.
  std::function<bool(Vec3, Vec3)> divides;
  /// Allowed depth of the proxy below the surface.
  double sunk_m = 1e-9;
};

/// The least height of a path over the surface, sampled three times, each time around the lowest sample: a
/// fast hand's samples are 8 um apart, and a crest that is cut between two of them may be 3 um higher than
/// both.
double lowest_over(const StrokedGround& ground, Vec3 from, Vec3 to) {
  constexpr int kRounds = 3;
  double begin = 0.0, end = 1.0, lowest_m = ground.height_over(to);
  for (int round = 0; round < kRounds; ++round) {
    double lowest_at = end;
    const double step = (end - begin) / kSamplesBetween;
    for (int k = 1; k <= kSamplesBetween; ++k) {
      const double at = begin + k * step;
      const double over_m = ground.height_over(from + at * (to - from));
      if (over_m < lowest_m) {
        lowest_m = over_m;
        lowest_at = at;
      }
    }
    begin = std::max(0.0, lowest_at - step);
    end = std::min(1.0, lowest_at + step);
  }
  return lowest_m;
}

/// One touch. If several models are given, the touch changes between them about every 20 ticks.
void wander(std::span<const StrokedGround> grounds, const Room& room, std::mt19937_64& random,
            StrokeFindings& findings) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> direction;
  const Vec3 size = room.high - room.low;
  Vec3 p = room.low + Vec3{size.x * unit(random), size.y * unit(random), size.z};
  Vec3 velocity;
  TouchState state;
  Hand hand;
  Vec3 last = p;
  LawOutput before;
  int left = 0;
  // Whether the hand has been in free air since the start, or since the last tick without force.
  bool is_free = true;
  const StrokedGround* ground = &grounds.front();
  double cut_before_m = 0.0;
  for (int n = 0; n < kTicks; ++n) {
    const bool changes = grounds.size() > 1 && n > 0 && unit(random) < 0.05;
    if (changes) {
      const StrokedGround& next =
          grounds[static_cast<std::size_t>(unit(random) * static_cast<double>(grounds.size()))];
      TouchState taken;
      next.touchable->take_over(ground->touchable->hand_over(state), taken);
      if (&next != ground) state = taken;
      ground = &next;
    }
    if (left-- == 0) {
      const Vec3 way{direction(random), direction(random), 0.5 * direction(random)};
      velocity = (kFastest_m_per_s * std::pow(10.0, -2.0 * unit(random)) / norm(way)) * way;
      left = 5 + static_cast<int>(75.0 * unit(random));
    }
    if (n > 0) p += kT_s * velocity;
    p = {bounced(p.x, room.low.x, room.high.x, velocity.x), bounced(p.y, room.low.y, room.high.y, velocity.y),
         bounced(p.z, room.low.z, room.high.z, velocity.z)};
    hand.position = {p};
    hand.velocity_m_per_s = {velocity};
    const LawOutput output = ground->touchable->evaluate(hand, state);
    const double force_N = norm(output.force_N);
    const bool inside = ground->height_over(p) < -kStrokeMargin_m;
    findings.inside += inside ? 1 : 0;
    findings.let_through += inside && !(output.contact && force_N > 0.0) ? 1 : 0;
    findings.pulled += dot(output.proxy.v - p, output.force_N.v) < -1e-9 ? 1 : 0;
    findings.sunk += ground->height_over(output.proxy.v) < -ground->sunk_m ? 1 : 0;
    findings.crossed += n > 0 && ground->divides(before.proxy.v, output.proxy.v) ? 1 : 0;
    is_free = is_free && lowest_over(*ground, last, p) > kStrokeMargin_m;
    findings.pushed_in_air += is_free && force_N > 0.0 ? 1 : 0;
    is_free = is_free || (!inside && !output.contact);
    // A hand in the air of which the surface lets go has no force at once, whatever it was. If it cut a crest
    // on its way, it is pushed by the depth of the cut, at most half of its way. Otherwise the force changes
    // by no more than stiffness times the movements of hand and proxy, and what the last tick's cut pushed.
    const double way_m = norm(p - last);
    const bool is_held =
        output.contact && force_N > 0.99 * kStrokeStiffness_N_per_m * norm(output.proxy.v - p);
    const double cut_m = is_held ? 0.0 : 0.5 * way_m;
    const double step_N = is_held ? norm(output.force_N - before.force_N) : force_N;
    const double moved_m = is_held ? way_m + norm(output.proxy - before.proxy) + cut_before_m : cut_m;
    const bool is_in_air = ground->height_over(p) > -kStrokeMargin_m;
    if (n > 0 && !changes &&
        (step_N > 1.05 * kStrokeStiffness_N_per_m * moved_m + 1e-6 || (!is_held && !is_in_air)))
      ++findings.kicked;
    cut_before_m = cut_m;
    before = output;
    last = p;
  }
}

void expect_held(const StrokeFindings& findings) {
  EXPECT_EQ(findings.let_through, 0) << "of " << findings.inside;
  EXPECT_EQ(findings.pulled, 0);
  EXPECT_EQ(findings.sunk, 0);
  EXPECT_EQ(findings.kicked, 0);
  EXPECT_EQ(findings.crossed, 0);
  EXPECT_EQ(findings.pushed_in_air, 0);
  EXPECT_GT(findings.inside, 5000);
}

TEST(Strokes, LetNoHandThroughReliefsOfAnyResolution) {
  std::mt19937 scenes(11);
  std::mt19937_64 random(12);
  StrokeFindings findings;
  for (const double pixel_m : {0.0001, 0.0003, 0.001, 0.002})
    for (const double friction : {0.0, 0.6}) {
      const models::Scene scene = rough_scene(pixel_m, scenes);
      const auto& relief = *models::relief_of(scene);
      LawParameters p = frictionless();
      p.stiffness_N_per_m = kStrokeStiffness_N_per_m;
      p.static_friction = friction;
      const auto law = made(scene, p);
      // Which steps a proxy may climb in a tick is tested by the trajectory study.
      const StrokedGround ground{law, [&](Vec3 at) { return at.z - relief.sample(at.x, at.y).z_m; },
                                 [](Vec3, Vec3) { return false; }};
      for (int k = touches(); k > 0; --k)
        wander({&ground, 1}, {{-0.028, -0.018, -0.001}, {0.028, 0.018, 0.014}}, random, findings);
    }
  expect_held(findings);
}

/// Upright walls two pixels thick, 8 mm high and 8 mm apart, on level ground.
models::Scene thin_walls(double pixel_m) {
  Raster<float> z(static_cast<int>(std::lround(0.04 / pixel_m)),
                  static_cast<int>(std::lround(0.04 / pixel_m)));
  const int period = static_cast<int>(std::lround(0.008 / pixel_m));
  for (int j = 0; j < z.height(); ++j)
    for (int i = period; i < z.width(); i += period) z(i - 1, j) = z(i, j) = 0.008F;
  return scene_of(std::move(z), pixel_m);
}

StrokedGround walled_ground(const models::Scene& scene, double friction, double radius_m = 0.0) {
  LawParameters p = frictionless(radius_m);
  p.stiffness_N_per_m = kStrokeStiffness_N_per_m;
  p.static_friction = friction;
  DilatedRelief dilated;
  const auto law = make_touchable(scene, p, &dilated);
  const auto surface = radius_m > 0.0 ? dilated.surface : models::relief_of(scene);
  return {*law, [surface](Vec3 at) { return at.z - surface->sample(at.x, at.y).z_m; },
          [top_m = surface->highest_m()](Vec3 a, Vec3 b) {
            // Walls stand at 4 mm and every 8 mm.
            const double wall = 0.008 * std::round((0.5 * (a.x + b.x) - 0.004) / 0.008) + 0.004;
            return (a.x < wall) != (b.x < wall) && std::max(a.z, b.z) < top_m - 0.003;
          }};
}

constexpr Room kAmongWalls{{-0.015, -0.015, -0.004}, {0.015, 0.015, 0.009}};

TEST(Strokes, LetNoHandThroughWallsOfTwoPixelsOfARelief) {
  std::mt19937_64 random(14);
  StrokeFindings findings;
  for (const double pixel_m : {0.0001, 0.00025})
    for (const double friction : {0.0, 0.6}) {
      const StrokedGround ground = walled_ground(thin_walls(pixel_m), friction);
      for (int k = touches(); k > 0; --k) wander({&ground, 1}, kAmongWalls, random, findings);
    }
  expect_held(findings);
}

TEST(Strokes, LetNoHandThroughWallsOfAReliefWhileSceneRadiusAndFrictionChange) {
  std::mt19937_64 random(15);
  StrokeFindings findings;
  const std::vector<StrokedGround> grounds{
      walled_ground(thin_walls(0.0001), 0.0), walled_ground(thin_walls(0.0001), 0.6, 0.0005),
      walled_ground(thin_walls(0.0001), 0.0, 0.00051), walled_ground(thin_walls(0.0002), 0.3, 0.0015)};
  for (int k = 4 * touches(); k > 0; --k) wander(grounds, kAmongWalls, random, findings);
  expect_held(findings);
}

TEST(Strokes, KeepAProxyAtTheFootOfAWallOnItsSideWhenTheBallGrows) {
  const StrokedGround small = walled_ground(thin_walls(0.0001), 0.0);
  const StrokedGround large = walled_ground(thin_walls(0.0002), 0.0, 0.0015);
  constexpr double kWall_m = 0.004;
  constexpr double kDeep_m = -0.002;
  for (const double side : {-1.0, 1.0})
    for (const double beyond_m : {0.0005, 0.002, 0.005, 0.012}) {
      TouchState state;
      LawOutput output;
      for (double z = 0.009; z > kDeep_m; z -= 1e-4)
        output = output_at(*small.touchable, state, {kWall_m + 0.002 * side, 0.001, z});
      // Below the wall and beyond it: the proxy stays at the foot of the wall.
      for (double x = 0.002; x > -beyond_m; x -= 1e-4)
        output = output_at(*small.touchable, state, {kWall_m + x * side, 0.001, kDeep_m});
      ASSERT_GT(side * (output.proxy.v.x - kWall_m), 0.0);
      TouchState taken;
      large.touchable->take_over(small.touchable->hand_over(state), taken);
      for (int n = 0; n < 50; ++n) {
        output = output_at(*large.touchable, taken, {kWall_m - beyond_m * side, 0.001, kDeep_m});
        ASSERT_TRUE(output.contact);
        ASSERT_GT(side * (output.proxy.v.x - kWall_m), 0.0) << side << " " << beyond_m << " tick " << n;
      }
    }
}

template <class Solid>
StrokedGround solid_ground(double friction, double radius_m = 0.0) {
  const Solid solid;
  return {std::make_shared<const SolidTouchable<Solid>>(friction, radius_m),
          [=](Vec3 at) { return solid.sample({at}).distance_m - radius_m; }, &Solid::divides,
          0.1 * solid.cell_m()};
}

constexpr Room kAmongSolids{{-0.02, -0.02, -0.004}, {0.02, 0.02, 0.012}};

template <class Solid>
StrokeFindings over_solid() {
  std::mt19937_64 random(13);
  StrokeFindings findings;
  for (const double friction : {0.0, 0.6}) {
    const StrokedGround ground = solid_ground<Solid>(friction);
    for (int k = 4 * touches(); k > 0; --k) wander({&ground, 1}, kAmongSolids, random, findings);
  }
  return findings;
}

TEST(Strokes, LetNoHandThroughBallsOnAPlate) { expect_held(over_solid<Pebbles>()); }

TEST(Strokes, LetNoHandThroughThinWallsOfASolid) { expect_held(over_solid<Walls>()); }

TEST(Strokes, LetNoHandThroughThinWallsOfASolidWhileRadiusAndFrictionChange) {
  std::mt19937_64 random(16);
  StrokeFindings findings;
  const std::vector<StrokedGround> grounds{solid_ground<Walls>(0.0), solid_ground<Walls>(0.6, 0.0005),
                                           solid_ground<Walls>(0.0, 0.00051),
                                           solid_ground<Walls>(0.3, 0.0015)};
  for (int k = 8 * touches(); k > 0; --k) wander(grounds, kAmongSolids, random, findings);
  expect_held(findings);
}

}  // namespace
}  // namespace palpable::haptics
