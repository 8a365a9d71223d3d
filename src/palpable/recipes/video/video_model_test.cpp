// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_model.hpp"

#include "palpable/recipes/video/seen_house.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

TEST(VideoModel, MeasuresTheNoiseOfTheGroundAndRaisesOnlyWhatIsAboveIt) {
  // A depth of about 1.2 with an error of 0.4 %, seen at about 45 degrees: some 3.4 units of 1/1000 of
  // height.
  const auto maps = maps_of_house(3, 0.004);
  VideoModelOptions model_options;
  model_options.structure_step_px = 2;
  const VideoModel model = video_model(maps, model_options, 1);
  EXPECT_GT(model.ground_noise, 0.0022);
  EXPECT_LT(model.ground_noise, 0.0050);
  EXPECT_GE(model.raised_above - model.ground_height, 4 * model.ground_noise);
  // What is raised is the house: hardly any of the table's points is far outside it.
  const auto axes_inverse = model.axes.axes_from_world().inverse();
  const auto beside = std::count_if(model.raised.begin(), model.raised.end(), [&](const Vec3& p) {
    return outside_house((axes_inverse * Point<SceneFrame>{p}).v) > 0.03;
  });
  EXPECT_LT(static_cast<double>(beside), 0.002 * static_cast<double>(model.raised.size()));
}

TEST(VideoModel, FlattensTheGroundAndLeavesTheHouse) {
  auto maps = maps_of_house(3, 0.001);
  const auto before = maps;
  VideoModelOptions options;
  options.structure_step_px = 2;
  const VideoModel model = video_model(maps, options, 1);
  flatten_ground(maps, model, options);
  const auto axes_from_world = model.axes.axes_from_world();
  int ground = 0, flat = 0;
  for (std::size_t k = 0; k < maps.size(); ++k)
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x) {
        const double was = (axes_from_world * place_of_pixel(before[k], x, y)).v.z,
                     is = (axes_from_world * place_of_pixel(maps[k], x, y)).v.z;
        if (was > 0.05) {
          EXPECT_EQ(is, was);
        }
        if (std::abs(was) < 0.002) ++ground, flat += std::abs(is) < 1e-6 ? 1 : 0;
      }
  EXPECT_GT(ground, 3000);
  EXPECT_GT(flat, 0.9 * ground);
}

}  // namespace
}  // namespace palpable::recipes
