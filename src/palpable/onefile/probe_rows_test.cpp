// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/probe_rows.hpp"

#include "palpable/haptics/law/laws.hpp"
#include "palpable/onefile/scene_bytes.hpp"
#include "palpable/onefile/test_scenes.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace palpable::onefile {
namespace {

/// A path over the middle of the scenes, in contact for a part of it.
std::vector<ProbeRow> path() {
  std::vector<ProbeRow> rows;
  for (int i = 0; i < 400; ++i) {
    const double t = 0.001 * i;
    rows.push_back(
        {t, 0.003 * std::sin(7.0 * t), 0.003 * std::sin(11.0 * t), 0.003 + 0.003 * std::cos(9.0 * t)});
  }
  return rows;
}

TEST(ProbeRows, AreTheSameAfterTheWayThroughBytes) {
  for (const models::Scene& scene : scenes_of_all_kinds()) {
    const auto back = decode_scene_bytes(encode_scene_bytes(scene));
    ASSERT_TRUE(back);
    for (const auto law : haptics::laws_for(scene)) {
      if (haptics::description_of(law).degrees_of_freedom == 6) continue;
      const std::string options = R"({"law": ")" + std::string(haptics::name_of(law)) + R"("})";
      const auto before = probe_rows(scene, options, path()), after = probe_rows(*back, options, path());
      ASSERT_TRUE(before && after) << haptics::name_of(law);
      EXPECT_EQ(*before, *after) << haptics::name_of(law);
      double strongest_N = 0.0;
      for (const ForceRow& force : *before)
        strongest_N = std::max(strongest_N, std::abs(force[2]) + std::abs(force[0]));
      EXPECT_GT(strongest_N, 0.0) << models::kind_of(scene.model) << " " << haptics::name_of(law);
    }
  }
}

TEST(ProbeRows, TakeTheOptionsOfTheCommandLine) {
  models::Scene scene = hills_scene();
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(40, 30, 0.002F), 0.001));
  scene.labels = {};
  // A level floor of 2 mm, 1 mm below it, then with a ball of 1 mm around the same place.
  const std::vector<ProbeRow> rows{{0.0, 0.0, 0.0, 0.003}, {0.001, 0.0, 0.0, 0.001}, {1.0, 0.0, 0.0, 0.001}};
  const auto force = [&](const std::string& options) { return (*probe_rows(scene, options, rows))[2][2]; };
  EXPECT_NEAR(force(R"({"law": "proxy", "stiffness": 400, "friction": 0})"), 0.4, 1e-6);
  EXPECT_NEAR(force(R"({"law": "proxy", "stiffness": 400, "friction": 0, "radius": 1})"), 0.8, 1e-6);
  EXPECT_NEAR(force(R"({"law": "penalty", "stiffness": 100})"), 0.1, 1e-6);
}

TEST(ProbeRows, SayWhatIsWrongWithTheOptionsAndRows) {
  const models::Scene scene = hills_scene();
  const auto sentence = [&](const std::string& options, std::vector<ProbeRow> rows) {
    const auto forces = probe_rows(scene, options, rows);
    return forces ? std::string() : forces.error().sentence();
  };
  const std::vector<ProbeRow> good{{0.0, 0.0, 0.0, 0.0}};
  EXPECT_EQ(sentence("{}", good), "");
  EXPECT_EQ(sentence("[]", good), "the options must be an object");
  EXPECT_EQ(sentence(R"({"law": "tracing"})", good), "the scene, a relief, has no law tracing");
  EXPECT_EQ(sentence(R"({"law": 3})", good), "the law must be a name");
  EXPECT_EQ(sentence(R"({"stiffnes": 3})", good), "no law has the option stiffnes");
  EXPECT_EQ(sentence(R"({"stiffness": "stiff"})", good), "the option stiffness must be a number");
  EXPECT_EQ(sentence("{}", {}), "the path has no samples");
  EXPECT_EQ(sentence("{}", {{0.0, std::nan(""), 0.0, 0.0}}), "sample 1 is not finite");
}

TEST(ProbeRows, RefuseABallForALawThatTouchesWithAPoint) {
  const models::Scene scene = models::grid_scene({21, 21, 8}, 0.003F, [](int z) { return z <= 4; });
  const auto forces = probe_rows(scene, R"({"law": "grid", "radius": 2})", path());
  ASSERT_FALSE(forces);
  EXPECT_EQ(forces.error().sentence(), "the law grid touches with a point: give no radius");
  EXPECT_TRUE(probe_rows(scene, R"({"law": "grid", "radius": 0})", path()));
}

}  // namespace
}  // namespace palpable::onefile
