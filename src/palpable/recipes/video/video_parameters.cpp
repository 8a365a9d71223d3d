// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_recipe.hpp"

namespace palpable::recipes {

std::vector<Parameter> parameters_of(FollowingOptions& o) {
  return {{"most_frames",
           &o.most_frames,
           {0, 1},
           "",
           "Share of the frames that must share points with both of the next two"},
          {"times_least",
           &o.times_least,
           {1, 20},
           "",
           "Points that they must share, in points that a pose needs"},
          {"bridge", &o.bridge, {1, 20}, "", "Frames matched on each side of a gap between them"}};
}

std::vector<Parameter> parameters_of(VideoSurfaceOptions& o) {
  return {{"least_part",
           &o.least_part,
           {0, 1},
           "",
           "Smaller parts of the fused surface are left out, share of its longest side"},
          {"most_triangles",
           &o.most_triangles,
           {0, 100000000},
           "",
           "Triangles of a fused surface from which on its voxels are larger; 0 = never"}};
}

std::vector<Parameter> parameters_of(VideoRecipe& recipe) {
  std::vector<Parameter> out;
  append_parameters(out, "frames", vision::parameters_of(recipe.frames));
  append_parameters(out, "tracks", vision::parameters_of(recipe.tracks));
  append_parameters(out, "following", parameters_of(recipe.following));
  append_parameters(out, "photos", vision::parameters_of(recipe.photos));
  append_parameters(out, "motion", vision::parameters_of(recipe.motion));
  append_parameters(out, "filter", vision::parameters_of(recipe.filter));
  append_parameters(out, "moving", vision::parameters_of(recipe.moving));
  append_parameters(out, "covered", vision::parameters_of(recipe.covered));
  append_parameters(out, "depth", vision::parameters_of(recipe.depth));
  append_parameters(out, "model", parameters_of(recipe.model));
  append_parameters(out, "fused", parameters_of(recipe.fused));
  append_parameters(out, "shapes", parameters_of(recipe.shapes));
  append_parameters(out, "corrected", parameters_of(recipe.corrected));
  append_parameters(out, "growth", parameters_of(recipe.growth));
  append_parameters(out, "scale", parameters_of(recipe.scale));
  append_parameters(out, "advice", parameters_of(recipe.advice));
  return out;
}

}  // namespace palpable::recipes
