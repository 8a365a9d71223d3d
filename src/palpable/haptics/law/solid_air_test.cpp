// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Laws on fields: hands that move at random around solids, near to them and far away, also outside the
// field's box. No law pushes a hand whose way was clear, and a hand that is inside at the end of the tick of
// its first contact is pushed in that tick. The ground truth is the field itself, at many places of each
// tick.
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/models/field/field.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

using DistanceTo = std::function<double(Vec3)>;

/// How a solid is sampled: how far apart, and how far around it.
struct Sampling {
  double spacing_m = 2.5e-4;
  double around_m = 2e-3;
};
/// The largest ball that may touch a field with the least margin.
constexpr double kLargestBall_m = Sampling{}.around_m - 0.5 * Sampling{}.spacing_m - 1e-9;

models::Scene sampled_solid(const DistanceTo& distance_to, Vec3 least_m, Vec3 most_m,
                            const Sampling& sampling = {}) {
  models::Lattice lattice;
  lattice.origin_m = least_m - sampling.around_m * Vec3{1.0, 1.0, 1.0};
  lattice.spacing_m = sampling.spacing_m;
  const Vec3 size = most_m - least_m;
  const auto count = [&](double extent_m) {
    return static_cast<int>(std::ceil((extent_m + 2.0 * sampling.around_m) / sampling.spacing_m)) + 1;
  };
  lattice.counts = {count(size.x), count(size.y), count(size.z)};
  std::vector<float> values(lattice.places());
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x)
        values[lattice.index(x, y, z)] = static_cast<float>(distance_to(lattice.place_m(x, y, z)));
  auto dense = models::DenseField::from(lattice, models::DenseContent::distance, std::move(values), {});
  models::Scene scene;
  scene.model =
      std::make_shared<const models::FieldOnLattice>(*models::field_of(*std::move(dense), least_m, most_m));
  return scene;
}

constexpr double kBall_m = 0.006;
constexpr double kBeside_m = 0.008;

/// A solid with its true distance.
struct Solid {
  models::Scene scene;
  DistanceTo distance_to;

  /// In the field's box its own, which is what is touched: sampling rounds creases.
  double touched_distance_m(Vec3 place_m) const {
    const auto& field = std::get<std::shared_ptr<const models::FieldOnLattice>>(scene.model)->distance;
    return field.contains({place_m}) ? field.sample({place_m}).distance_m : distance_to(place_m);
  }
};

/// Two balls beside each other, 4 mm apart.
Solid two_balls(const Sampling& sampling = {}) {
  const DistanceTo distance_to = [](Vec3 p) {
    return norm(Vec3{std::abs(p.x) - kBeside_m, p.y, p.z}) - kBall_m;
  };
  return {sampled_solid(distance_to, {-0.014, -0.006, -0.006}, {0.014, 0.006, 0.006}, sampling), distance_to};
}

/// Eight balls of 2 to 5 mm, some of them apart.
Solid random_balls(unsigned seed) {
  struct OneOfTheBalls {
    Vec3 middle_m;
    double radius_m;
  };
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<OneOfTheBalls> balls;
  Vec3 least_m{1.0, 1.0, 1.0};
  Vec3 most_m{-1.0, -1.0, -1.0};
  for (int k = 0; k < 8; ++k) {
    const OneOfTheBalls ball{
        {0.024 * (unit(random) - 0.5), 0.02 * (unit(random) - 0.5), 0.01 * (unit(random) - 0.5)},
        0.002 + 0.003 * unit(random)};
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      least_m.*axis = std::min(least_m.*axis, ball.middle_m.*axis - ball.radius_m);
      most_m.*axis = std::max(most_m.*axis, ball.middle_m.*axis + ball.radius_m);
    }
    balls.push_back(ball);
  }
  const DistanceTo distance_to = [balls](Vec3 p) {
    double least = 1.0;
    for (const OneOfTheBalls& ball : balls) least = std::min(least, norm(p - ball.middle_m) - ball.radius_m);
    return least;
  };
  return {sampled_solid(distance_to, least_m, most_m), distance_to};
}

struct Air {
  int clear_ticks = 0;
  int contacts = 0;
  int pushed = 0;
  int late = 0;
  double most_N = 0.0;
};

/// A hand of `reach_m` (the part of it that touches is within that of its position) flies in random straight
/// lines at 0.01 to 2 m/s; a touch ends soon after its first contact.
void fly_about(const Touchable& law, const Solid& solid, double reach_m, std::mt19937_64& random, Air& air) {
  constexpr int kBetween = 50;
  // What sampling changes outside the box, and more.
  constexpr double kMargin_m = 3e-5;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto clearance_m = [&](Vec3 p) { return solid.touched_distance_m(p) - reach_m; };
  // Hands also come from far outside of the field's box.
  const auto anywhere = [&] {
    return Vec3{0.08 * (unit(random) - 0.5), 0.06 * (unit(random) - 0.5), 0.05 * (unit(random) - 0.5)};
  };
  TouchState state;
  Hand hand;
  Vec3 p = anywhere();
  if (clearance_m(p) <= kMargin_m) return;
  output_at(law, state, p);
  for (int way = 0; way < 6; ++way) {
    const Vec3 to = anywhere();
    const double speed_m_per_s = 2.0 * std::pow(10.0, -2.3 * unit(random));
    const int ticks = std::clamp(static_cast<int>(norm(to - p) / (speed_m_per_s * kT_s)), 1, 400);
    const Vec3 step = speed_m_per_s * kT_s * palpable::unit(to - p);
    for (int n = 0; n < ticks; ++n) {
      const Vec3 last = p;
      p += step;
      bool is_clear = true;
      for (int k = 1; is_clear && k <= kBetween; ++k)
        is_clear = clearance_m(last + (static_cast<double>(k) / kBetween) * step) > kMargin_m;
      hand.position = {p};
      // A damper that may cancel the push is not judged here.
      hand.velocity_m_per_s = {};
      const LawOutput output = law.evaluate(hand, state);
      const double force_N = norm(output.force_N) + norm(output.torque_Nm);
      if (!is_clear) {
        ++air.contacts;
        air.late += clearance_m(p) < -kMargin_m && !(output.contact && force_N > 0.0) ? 1 : 0;
        return;
      }
      ++air.clear_ticks;
      air.pushed += output.contact || force_N > 0.0 ? 1 : 0;
      air.most_N = std::max(air.most_N, force_N);
    }
  }
}

struct AirCase {
  Law law = Law::proxy;
  double friction = 0.0;
  double radius_m = 0.0;
};

Air air_around(const Solid& solid, const AirCase& touched, int flights, std::mt19937_64& random) {
  LawParameters p;
  p.law = touched.law;
  p.stiffness_N_per_m = 500.0;
  p.damping_Ns_per_m = 0.5;
  if (touched.law == Law::tool) {
    p.tool_radius_m = touched.radius_m;
  } else {
    p.radius_m = touched.radius_m;
  }
  if (touched.law == Law::proxy) p.static_friction = touched.friction;
  const auto law = made(solid.scene, p);
  Air air;
  for (int k = 0; k < flights; ++k) fly_about(*law, solid, touched.radius_m, random, air);
  return air;
}

TEST(SolidAir, HasNoForceForAnyLawWithContactAndAnyRadius) {
  std::mt19937_64 random(31);
  std::vector<Solid> solids{two_balls()};
  for (const unsigned seed : {1U, 2U, 3U, 4U}) solids.push_back(random_balls(seed));
  Air all;
  for (const Solid& solid : solids)
    for (const AirCase touched :
         {AirCase{Law::proxy, 0.0, 0.0}, AirCase{Law::proxy, 0.5, 0.0}, AirCase{Law::proxy, 0.3, 0.001},
          AirCase{Law::proxy, 0.0, kLargestBall_m}, AirCase{Law::penalty, 0.0, 0.0},
          AirCase{Law::penalty, 0.0, 0.001}, AirCase{Law::penalty, 0.0, kLargestBall_m},
          AirCase{Law::tool, 0.0, 0.008}}) {
      const Air air = air_around(solid, touched, 60, random);
      EXPECT_EQ(air.pushed, 0) << name_of(touched.law) << " friction " << touched.friction << " radius "
                               << touched.radius_m << ": " << air.most_N << " N";
      // Only some points of a tool touch.
      if (touched.law != Law::tool) {
        EXPECT_EQ(air.late, 0) << name_of(touched.law) << " radius " << touched.radius_m << " of "
                               << air.contacts;
      }
      all.clear_ticks += air.clear_ticks;
      all.contacts += air.contacts;
    }
  EXPECT_GT(all.clear_ticks, 100000);
  EXPECT_GT(all.contacts, 500);
}

TEST(SolidAir, HasNoForceForABallOfTwentyMillimetresOnAFieldWithRoomForIt) {
  constexpr double kRadius_m = 0.02;
  constexpr double kSpacing_m = 5e-4;
  std::mt19937_64 random(35);
  const Solid solid = two_balls({kSpacing_m, kRadius_m + 0.5 * kSpacing_m + 1e-5});
  for (const Law law : {Law::proxy, Law::penalty}) {
    const Air air = air_around(solid, {law, 0.0, kRadius_m}, 200, random);
    EXPECT_EQ(air.pushed, 0) << name_of(law) << ": " << air.most_N << " N";
    EXPECT_EQ(air.late, 0) << name_of(law) << " of " << air.contacts;
    EXPECT_GT(air.contacts, 50) << name_of(law);
  }
}

/// The work of `penalty` on a hand led once around a circle whose middle is near a solid's surface.
double work_on_circle_J(const Touchable& law, double around_m, std::mt19937_64& random) {
  constexpr int kSteps = 4000;
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Vec3 middle{0.016 * unit(random), 0.008 * unit(random), 0.008 * unit(random)};
  const Vec3 a = palpable::unit(Vec3{unit(random), unit(random), unit(random)});
  const Vec3 b = palpable::unit(cross(a, Vec3{unit(random), unit(random), unit(random)}));
  const auto at = [&](int k) {
    const double angle = 2.0 * std::numbers::pi * k / kSteps;
    return middle + around_m * (std::cos(angle) * a + std::sin(angle) * b);
  };
  double work_J = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    TouchState state;
    work_J += dot(output_at(law, state, 0.5 * (at(k) + at(k + 1))).force_N.v, at(k + 1) - at(k));
  }
  return work_J;
}

TEST(SolidAir, ClosedPathsOfTheLargestBallMakeNoEnergy) {
  LawParameters p;
  p.law = Law::penalty;
  p.stiffness_N_per_m = 500.0;
  p.damping_Ns_per_m = 0.0;
  p.radius_m = kLargestBall_m;
  std::mt19937_64 random(33);
  const Solid solid = two_balls();
  const auto law = made(solid.scene, p);
  for (int k = 0; k < 40; ++k) EXPECT_LE(std::abs(work_on_circle_J(*law, 0.003, random)), 1e-6);
}

TEST(SolidAir, LargerBallsThanTheMarginAreRefusedWithTheLargestRadius) {
  const Solid solid = two_balls();
  for (const Law law : {Law::proxy, Law::penalty}) {
    EXPECT_NEAR(largest_radius_m(solid.scene, law), kLargestBall_m, 1e-8);
    LawParameters p;
    p.law = law;
    p.radius_m = 0.003;
    const auto refused = make_touchable(solid.scene, p);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    const std::string& words = refused.error().message;
    EXPECT_NE(words.find("the largest radius is 1.87 mm"), std::string::npos) << words;
    // Half a spacing more than the ball.
    EXPECT_NE(words.find("(field.margin_m) of 0.00313 m"), std::string::npos) << words;
    EXPECT_GE(largest_radius_m(two_balls({2.5e-4, 0.00313}).scene, law), 0.003);
  }
  // A ball that rolls on the view from above does not touch the field.
  EXPECT_TRUE(std::isinf(largest_radius_m(solid.scene, Law::rolling)));
}

/// The greatest force of the law `rolling` on a resting hand: anywhere, and where no part of the solid is
/// above or below the hand or within three pixels of the view from above.
struct RollingForce {
  double most_N = 0.0;
  double most_beside_N = 0.0;
  int beside = 0;
};

RollingForce rolling_force(const Solid& solid) {
  LawParameters p;
  p.law = Law::rolling;
  p.slope_force_N = 1.0;
  const auto law = made(solid.scene, p);
  const auto& above = *models::relief_of(solid.scene);
  const auto is_beside = [&](double x_m, double y_m) {
    constexpr double kStep_m = 1e-4;
    const double beside_m = 3.0 * std::sqrt(2.0) * above.pixel_m() + kStep_m;
    for (double z_m = -0.007; z_m < 0.009; z_m += kStep_m)
      if (solid.distance_to({x_m, y_m, z_m}) < beside_m) return false;
    return true;
  };
  RollingForce found;
  std::mt19937_64 random(32);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 20000; ++k) {
    const double reach = k % 2 == 0 ? 0.6 : 2.0;
    const Vec3 at{reach * above.size_x_m() * unit(random), reach * above.size_y_m() * unit(random),
                  0.05 * unit(random)};
    TouchState state;
    const double force_N = norm(output_at(*law, state, at).force_N);
    found.most_N = std::max(found.most_N, force_N);
    if (!is_beside(at.x, at.y)) continue;
    ++found.beside;
    found.most_beside_N = std::max(found.most_beside_N, force_N);
  }
  return found;
}

TEST(SolidAir, HasNoForceBesideASolidThatABallRollsOn) {
  const RollingForce balls = rolling_force(two_balls());
  EXPECT_EQ(balls.most_beside_N, 0.0);
  EXPECT_GT(balls.beside, 5000);
  // The slope is limited to 3, like that of reliefs.
  EXPECT_GT(balls.most_N, 1.0);
  EXPECT_LE(balls.most_N, 3.0);
  for (const unsigned seed : {1U, 2U, 3U}) EXPECT_LE(rolling_force(random_balls(seed)).most_N, 3.0);
}

}  // namespace
}  // namespace palpable::haptics
