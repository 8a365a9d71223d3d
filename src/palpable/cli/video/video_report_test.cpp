// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/video/video_report.hpp"

#include "palpable/models/field/superquadric.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"

#include <gmock/gmock.h>

namespace palpable::cli {
namespace {

using testing::HasSubstr;

recipes::VideoReconstruction small_reconstruction() {
  recipes::VideoReconstruction out;
  for (int i = 0; i < 3; ++i) {
    recipes::VideoReconstruction::Pose pose;
    pose.frame_number = 5 * i;
    pose.world_from_camera.translation_m = {0.1 * i, -1, 1};
    out.poses.push_back(pose);
  }
  recipes::VideoReconstruction::Depth depth;
  depth.frame_number = 5;
  depth.map.camera = Pinhole{20, 20, 9.5, 7.5, 20, 16};
  depth.map.depth_m = Raster<float>(20, 16, 1.5F);
  depth.picture = Raster<Rgb8>(20, 16, Rgb8{10, 200, 30});
  out.depth_maps.push_back(depth);
  out.structure.places_m = {{0, 0, 0}, {0.1, 0.1, 0.1}};
  out.figures.frames = 4, out.figures.tried = 3, out.figures.posed = 3;
  using Kind = recipes::ModelStep::Kind;
  out.steps = {{Kind::segments, 5, 0.004, true},
               {Kind::superquadrics, 5, 0.001, true},
               {Kind::superquadrics, 10, 0.0012, false},
               {Kind::sampling, 10, 0.0008, true},
               {Kind::correction, 10, 0.00025, true}};
  out.advice.emplace_back("The left side was never seen, so the shape there is a guess.");
  return out;
}

TEST(VideoReport, ShowsEveryStageWithAlternativeTextsAndTheAdvice) {
  models::Superquadric ball;
  ball.size_m = {0.03, 0.03, 0.02};
  recipes::FieldRecipe recipe;
  recipe.field.resolution = 32;
  // It is drawn in a third of the time of an adaptive field.
  recipe.storage = recipes::FieldStorage::dense;
  const auto made = recipes::field_from_superquadrics({ball}, recipe, {});
  ASSERT_TRUE(made) << made.error().sentence();
  const auto page = video_report("model <1>.mp4", small_reconstruction(), made->scene, {Note("A note.")});
  ASSERT_TRUE(page) << page.error().sentence();
  for (const char* part :
       {"model &lt;1&gt;.mp4", "<h2>What to do better</h2>", "The left side was never seen",
        "alt=\"Picture 5 of the video", "alt=\"Two plots of the camera",
        "alt=\"The model from above, 60 x 60 x 40 mm", "alt=\"The model, 60 x 60 x 40 mm", "A note.",
        "3 of 3", "<h2>How the model grew</h2>", "<h2>The true size</h2>", "data-frame=\"5\"",
        "1.00 mm for the superquadrics alone, 0.25 mm after"})
    EXPECT_THAT(*page, HasSubstr(part));
}

}  // namespace
}  // namespace palpable::cli
