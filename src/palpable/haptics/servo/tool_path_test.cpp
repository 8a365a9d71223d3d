// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/tool_path.hpp"

#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/servo/probe_path.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// The solid below z = 0 as a dense field, 20 mm across, 500 N/m.
models::Scene floor_scene() {
  const models::Lattice lattice{{-0.02, -0.02, -0.01}, 0.001, {41, 41, 21}};
  std::vector<float> values;
  for (int z = 0; z < 21; ++z)
    for (int k = 0; k < 41 * 41; ++k) values.push_back(static_cast<float>(lattice.place_m(0, 0, z).z));
  auto dense = models::DenseField::from(lattice, models::DenseContent::distance, std::move(values), {});
  EXPECT_TRUE(dense);
  auto field = models::field_of(*std::move(dense), {-0.02, -0.02, -0.01}, {0.02, 0.02, 0.0});
  EXPECT_TRUE(field);
  models::Scene scene;
  scene.model = std::make_shared<const models::FieldOnLattice>(*std::move(field));
  return scene;
}

std::shared_ptr<const Touchable> floor_with(Law law, double damping_Ns_per_m = 0.0) {
  LawParameters parameters;
  parameters.law = law;
  parameters.damping_Ns_per_m = damping_Ns_per_m;
  parameters.static_friction = 0.0;
  return *make_touchable(floor_scene(), parameters);
}

ToolPose pose_at(double t_s, Vec3 place_m, int probe = 0, double tilt_rad = 0.0) {
  ToolPose pose{t_s, probe, {}};
  pose.scene_from_tool.rotation =
      models::rotation_of({std::cos(0.5 * tilt_rad), 0.0, std::sin(0.5 * tilt_rad), 0.0});
  pose.scene_from_tool.translation_m = place_m;
  return pose;
}

const models::DenseField& field_of_floor(const models::Scene& scene) {
  return std::get<std::shared_ptr<const models::FieldOnLattice>>(scene.model)->distance;
}

TEST(ToolPath, GivesTheWrenchOfThePenaltyLaw) {
  const models::Scene scene = floor_scene();
  const auto pad = cap_places(0.008, 1.0, 24);
  const std::array poses{pose_at(0.0, {0.001, 0.002, 0.0075}), pose_at(0.01, {0.001, 0.002, 0.006}, 0, 0.4)};
  std::size_t at = 0;
  probe_tools(*floor_with(Law::penalty), pad, poses, [&](const ToolPose& pose, const ToolOutput& felt) {
    const Wrench wrench = tool_wrench(field_of_floor(scene), pad, pose.scene_from_tool, 500.0);
    EXPECT_TRUE(felt.contact);
    EXPECT_NEAR(norm(felt.force_N - wrench.force_N), 0.0, 1e-12);
    EXPECT_NEAR(norm(felt.torque_Nm - wrench.torque_Nm), 0.0, 1e-15);
    ++at;
  });
  EXPECT_EQ(at, 2U);
}

TEST(ToolPath, TurnsATiltedStickBackToTheFloor) {
  // The tool is held at its middle, its right end below the floor: the upward force at that end rotates the
  // tool about -y.
  const std::array<ToolPlace, 2> stick{{{{{-0.01, 0.0, 0.0}}, 0.5}, {{{0.01, 0.0, 0.0}}, 0.5}}};
  std::vector<ToolPose> poses{pose_at(0.0, {0.0, 0.0, 0.001})};
  for (int i = 1; i < 20; ++i) poses.push_back(pose_at(0.001 * i, {}, 0, 0.2));
  ToolOutput last;
  probe_tools(*floor_with(Law::proxy), stick, poses,
              [&](const ToolPose&, const ToolOutput& felt) { last = felt; });
  const double depth_m = 0.01 * std::sin(0.2), force_N = 0.5 * 500.0 * depth_m;
  EXPECT_NEAR(last.force_N.v.z, force_N, 1e-4 * force_N);
  EXPECT_NEAR(last.torque_Nm.v.y, -0.01 * std::cos(0.2) * force_N, 1e-3 * 0.01 * force_N);
  EXPECT_FALSE(last.has_proxy);
}

TEST(ToolPath, KeepsEachProbesTouchApart) {
  // Two fingers evaluated alternately: each has the forces and the proxy that it has alone.
  const auto touchable = floor_with(Law::proxy);
  const std::array<ToolPlace, 1> point{};
  const auto place = [](int i, int finger) {
    return Vec3{(finger == 0 ? -0.01 : 0.01) + 2e-5 * i, 0.0, 0.002 - 1e-4 * i};
  };
  std::vector<ToolPose> poses;
  std::array<std::vector<PathSample>, 2> alone;
  for (int i = 0; i < 60; ++i)
    for (int finger = 0; finger < 2; ++finger) {
      poses.push_back(pose_at(0.001 * i, place(i, finger), finger));
      alone[static_cast<std::size_t>(finger)].push_back({0.001 * i, {place(i, finger)}});
    }
  std::array<std::vector<LawOutput>, 2> expected;
  for (std::size_t finger = 0; finger < 2; ++finger)
    probe_path(*touchable, alone[finger],
               [&](const PathSample&, const LawOutput& output) { expected[finger].push_back(output); });
  std::array<std::size_t, 2> next{};
  probe_tools(*touchable, point, poses, [&](const ToolPose& pose, const ToolOutput& felt) {
    const auto finger = static_cast<std::size_t>(pose.probe);
    const LawOutput& output = expected[finger][next[finger]++];
    EXPECT_EQ(felt.force_N.v, output.force_N.v);
    EXPECT_EQ(felt.proxy.v, output.proxy.v);
    EXPECT_TRUE(felt.has_proxy);
    EXPECT_EQ(felt.torque_Nm.v, Vec3{});
  });
  EXPECT_EQ(next[1], 60U);
  EXPECT_TRUE(expected[1].back().contact);
}

TEST(ToolPath, TakesTheVelocityOfASensorWithAStepFromMoreThanItsLastReading) {
  // 4 mm/s into a damped floor, read in steps of 20 µm: every fifth tick is a step.
  constexpr double kStep_m = 2e-5;
  std::vector<ToolPose> poses;
  for (int i = 0; i < 400; ++i) {
    const double depth_m = kStep_m * std::round(4e-6 * i / kStep_m);
    poses.push_back(pose_at(0.001 * i, {0.0, 0.0, -depth_m}));
  }
  const auto touchable = floor_with(Law::penalty, 2.0);
  const std::array point{ToolPlace{}};
  const auto largest_change_N = [&](double sensor_step_m) {
    double largest_N = 0.0, last_N = 0.0;
    int tick = 0;
    probe_tools(
        *touchable, point, poses,
        [&](const ToolPose&, const ToolOutput& felt) {
          if (++tick > 50) largest_N = std::max(largest_N, std::abs(felt.force_N.v.z - last_N));
          last_N = felt.force_N.v.z;
        },
        sensor_step_m);
    return largest_N;
  };
  EXPECT_LT(largest_change_N(kStep_m), 0.5 * largest_change_N(0.0));
}

TEST(ToolPath, RefusesInvalidPosesAndTools) {
  const std::array good{pose_at(0.0, {}), pose_at(0.0, {}, 1), pose_at(0.1, {})};
  EXPECT_TRUE(check_poses(good));
  EXPECT_FALSE(check_poses({}));
  EXPECT_FALSE(check_poses(std::array{pose_at(0.0, {}), pose_at(0.0, {})}));
  EXPECT_FALSE(check_poses(std::array{pose_at(0.0, {}, kMaxProbes)}));
  EXPECT_FALSE(check_poses(std::array{pose_at(0.0, {NAN, 0.0, 0.0})}));
  EXPECT_FALSE(check_tool({}));
  EXPECT_FALSE(check_tool(std::array{ToolPlace{{{0.0, 0.0, 0.0}}, 0.0}}));
  EXPECT_FALSE(check_tool(std::array{ToolPlace{{{2.0, 0.0, 0.0}}, 1.0}}));
}

}  // namespace
}  // namespace palpable::haptics
