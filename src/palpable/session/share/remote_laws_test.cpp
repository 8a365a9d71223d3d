// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Every law over a link: what it generates there, and how its force differs from that of the scene.
#include "palpable/session/share/measured_remote_touch.hpp"

#include <cmath>
#include <functional>
#include <iostream>
#include <ostream>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

/// The hills of hilly_scene() as a grid of points 1 mm apart.
models::Scene grid_of_hills() {
  models::Scene scene = hilly_scene(kHills_m);
  const auto relief = models::relief_of(scene);
  models::Occupancy o;
  o.counts = {101, 81, 9};
  o.origin_m = {-0.05, -0.04, -0.002};
  o.spacing_m = 0.001;
  for (int z = 0; z < o.counts[2]; ++z)
    for (int y = 0; y < o.counts[1]; ++y)
      for (int x = 0; x < o.counts[0]; ++x) {
        const double height_m =
            relief->sample(o.origin_m.x + 0.001 * x, o.origin_m.y + 0.001 * y).z_m - o.origin_m.z;
        o.occupied.push_back(0.001 * z <= height_m ? 1 : 0);
      }
  scene.model =
      std::make_shared<const models::Grid>(models::Grid{*models::OccupancyGrid::from(o, Work{}), relief});
  return scene;
}

/// Two lines, along x and along y, with the hills as their grooves.
models::Scene two_lines() {
  Raster<models::BoundaryPixel> edges(100, 80);
  for (int y = 30; y < 34; ++y)
    for (int x = 10; x < 90; ++x) edges(x, y) = {1.0F, 0.0F};
  for (int y = 0; y < 80; ++y)
    for (int x = 50; x < 54; ++x) edges(x, y) = {-1.0F, 0.0F};
  models::Scene scene;
  scene.model = std::make_shared<const models::Contours>(
      models::Contours{*models::BoundaryMap::from_edges(std::move(edges), 0.001, 2.0, {}, Work{}),
                       models::relief_of(hilly_scene(kHills_m))});
  return scene;
}

struct RemoteLawCase {
  haptics::Law law;
  std::function<models::Scene()> scene;
  /// Of the force of the scene, without a delay.
  double most_difference;
  /// What it generates at most over any of the links. Planes: nothing but what the damper and friction took.
  double most_made_J = 2e-5;
  /// Slopes: what the hand gets at most beyond the scene's potential, and in all.
  double most_beyond_J = 0.0;
  double most_net_J = 0.0;
};

void PrintTo(const RemoteLawCase& c, std::ostream* out) { *out << haptics::name_of(c.law); }

class RemoteLaw : public testing::TestWithParam<RemoteLawCase> {};

TEST_P(RemoteLaw, KeepsItsLimitsWhateverTheLinkIsLike) {
  const RemoteLawCase& c = GetParam();
  const models::Scene scene = c.scene();
  const haptics::TickOptions limits;
  for (const LinkCase& link : kLinks) {
    const RemotelyTouched touched = remote_touch(scene, link.quality, 1, SentTextures::all, c.law);
    EXPECT_LE(touched.max_growth_N, 1e-6 + limits.max_force_rate_N_per_s * RemoteBench::kTick_s) << link.name;
    EXPECT_LE(touched.max_force_N, 3.3 + 1e-6) << link.name;
    if (c.most_net_J > 0.0) {
      EXPECT_LE(touched.beyond_potential_J, c.most_beyond_J) << link.name;
      EXPECT_LE(touched.net_work_J, c.most_net_J) << link.name;
    } else {
      EXPECT_LE(touched.counts.made_max_J, c.most_made_J) << link.name;
    }
    if (!(link.quality.delay_s > 0.0)) {
      EXPECT_GT(touched.rms_force_N, 0.02);
      EXPECT_LE(touched.rms_difference_N, c.most_difference * touched.rms_force_N);
    }
    if (prints_remote_touches())
      std::cout << haptics::name_of(c.law) << ", " << link.name << ": difference " << touched.rms_difference_N
                << " N of " << touched.rms_force_N << " N, growth " << touched.max_growth_N << " N, made "
                << 1e6 * touched.counts.made_max_J << " uJ (without controller "
                << 1e6 * touched.counts.made_max_without_controller_J << "), contact "
                << touched.contact_ticks << " ticks, beyond the potential "
                << 1e6 * touched.beyond_potential_J << " uJ, controller " << touched.counts.passivity_ticks
                << " ticks, net work " << 1e6 * touched.net_work_J << " uJ\n";
  }
}

models::Scene hills() { return hilly_scene(kHills_m); }

INSTANTIATE_TEST_SUITE_P(AllLaws, RemoteLaw,
                         testing::Values(RemoteLawCase{haptics::Law::proxy, hills, 0.05},
                                         RemoteLawCase{haptics::Law::penalty, hills, 0.1},
                                         RemoteLawCase{haptics::Law::averaged, hills, 0.1},
                                         RemoteLawCase{haptics::Law::grid, grid_of_hills, 0.4},
                                         RemoteLawCase{haptics::Law::rolling, hills, 0.3, 0.0, 3e-4, 2e-5},
                                         RemoteLawCase{haptics::Law::sobel, hills, 0.5, 0.0, 5e-4, 2e-4},
                                         RemoteLawCase{haptics::Law::groove, two_lines, 0.05}),
                         [](const auto& tested) { return std::string(haptics::name_of(tested.param.law)); });

}  // namespace
}  // namespace palpable::session
