// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/trajectory_study.hpp"

#include "palpable/haptics/law/laws.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace palpable::study {
namespace {

TEST(TrajectoryStudy, FindsThatTheProxyNeverPassesWallsGroovesOrSpikes) {
  TrajectoryStudyOptions options;
  options.trajectories = 4000;
  options.reliefs = 8;
  const auto found = study_trajectories(options, Work{});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->trajectories, 4000);
  EXPECT_GT(found->hand_below_surface, found->ticks / 10);
  EXPECT_EQ(found->let_through, 0);
  EXPECT_EQ(found->jumped_through, 0);
  EXPECT_EQ(found->proxy_below_surface, 0);
  EXPECT_EQ(found->force_away_from_proxy, 0);
  EXPECT_EQ(found->not_finite, 0);
  EXPECT_EQ(found->step_beyond_both_motions, 0);
  EXPECT_EQ(found->large_and_unlimited, 0);
  EXPECT_GT(found->large_steps, 0);
  EXPECT_EQ(found->largest.size(), std::min<std::size_t>(1000, static_cast<std::size_t>(found->large_steps)));
}

TEST(TrajectoryStudy, IsTheSameOnAnyNumberOfThreads) {
  TrajectoryStudyOptions options;
  options.trajectories = 400;
  options.reliefs = 3;
  Work one;
  one.threads = 1;
  Work three;
  three.threads = 3;
  const auto a = study_trajectories(options, one);
  const auto b = study_trajectories(options, three);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->hand_below_surface, b->hand_below_surface);
  EXPECT_EQ(a->large_steps, b->large_steps);
  ASSERT_EQ(a->largest.size(), b->largest.size());
  for (std::size_t k = 0; k < a->largest.size(); ++k) {
    EXPECT_EQ(a->largest[k].trajectory, b->largest[k].trajectory);
    EXPECT_EQ(a->largest[k].force_step_N, b->largest[k].force_step_N);
  }
}

/// A law that cannot hold a fast hand: it loses contact within a thin wall, as penalty laws do.
class FallsThroughWalls final : public haptics::Touchable {
 public:
  explicit FallsThroughWalls(std::shared_ptr<const models::Relief> relief) : relief_(std::move(relief)) {}
  haptics::LawOutput evaluate(const haptics::Hand& hand, haptics::TouchState&) const noexcept override {
    haptics::LawOutput output;
    output.has_proxy = true;
    const Vec3 p = hand.position.v;
    output.proxy = {{p.x, p.y, std::max(p.z, relief_->sample(p.x, p.y).z_m)}};
    output.contact = output.proxy.v.z > p.z && output.proxy.v.z - p.z < 0.002;
    if (output.contact) output.force_N = {500.0 * (output.proxy.v - p)};
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 1; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}

 private:
  std::shared_ptr<const models::Relief> relief_;
};

TEST(TrajectoryStudy, DetectsALawThatLetsTheHandThrough) {
  const auto relief = *obstacle_relief(3, 0.0);
  const FallsThroughWalls law(relief);
  TrajectoryFindings sum;
  TrajectoryStudyOptions options;
  options.fastest_m_per_s = 5.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto one = follow_trajectory(law, *relief, seed, options);
    sum.let_through += one.let_through;
    sum.jumped_through += one.jumped_through;
    sum.large_steps += one.large_steps;
  }
  EXPECT_GT(sum.let_through, 100);
  EXPECT_GT(sum.jumped_through, 10);
  EXPECT_GT(sum.large_steps, 100);
}

TEST(TrajectoryStudy, RefusesOptionsOutOfRange) {
  TrajectoryStudyOptions options;
  options.trajectories = 0;
  EXPECT_FALSE(study_trajectories(options, Work{}));
  options = {};
  options.fastest_m_per_s = 0.0;
  EXPECT_FALSE(study_trajectories(options, Work{}));
}

RC_GTEST_PROP(ProxyLaw, LetsNoStrokeThroughAnyGroundWithAnyFrictionOrBall, ()) {
  const auto ground = *rc::gen::inRange<std::uint64_t>(0, 1000);
  const auto stroke = *rc::gen::arbitrary<std::uint64_t>();
  const double slope = *rc::gen::element(0.0, 1.0, 3.0, 10.0);
  haptics::LawParameters p;
  p.static_friction = 0.01 * *rc::gen::inRange(0, 150);
  p.stiffness_N_per_m = *rc::gen::inRange(20, 3000);
  p.damping_Ns_per_m = 0.0;
  const auto relief = *obstacle_relief(ground, slope);
  models::Scene scene;
  scene.model = relief;
  TrajectoryStudyOptions options;
  options.ticks = 300;
  options.stiffness_N_per_m = *p.stiffness_N_per_m;
  options.fastest_m_per_s = 0.01 * *rc::gen::inRange(1, 101);
  const auto found = follow_trajectory(**haptics::make_touchable(scene, p), *relief, stroke, options);
  RC_ASSERT(found.let_through == 0);
  RC_ASSERT(found.jumped_through == 0);
  RC_ASSERT(found.proxy_below_surface == 0);
  RC_ASSERT(found.force_away_from_proxy == 0);
  RC_ASSERT(found.not_finite == 0);
  RC_ASSERT(found.step_beyond_both_motions == 0);
}

}  // namespace
}  // namespace palpable::study
