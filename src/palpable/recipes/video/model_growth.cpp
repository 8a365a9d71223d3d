// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/model_growth.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

std::string growth_sentence(const ModelStep& step, int frame_number, double error_m) {
  const char* what = "The model is corrected by the depth of frames up to";
  if (step.kind == ModelStep::Kind::superquadrics)
    what = "The model is made of simple shapes that follow the depth of frames up to";
  else if (step.kind == ModelStep::Kind::sampling)
    what = "The simple shapes are ready to be corrected by the depth of frames up to";
  return fmt::format("{} {}: {:.1f} mm from the measured points.", what, frame_number, 1000 * error_m);
}

}  // namespace

std::vector<Parameter> parameters_of(GrowthOptions& o) {
  return {{"least_gain", &o.least_gain, {0, 1}, "", "Share by which a shown state is better than the last"},
          {"resolution", &o.resolution, {16, 4096}, "", "Finest cells of a state along its longest side"}};
}

ModelStepObserver growing_fields(const GrowthOptions& options, FieldRecipe field,
                                 std::vector<int> frame_numbers, TakeState take, const Work& work) {
  if (!take) return {};
  field.field.resolution = std::min(field.field.resolution, options.resolution);
  Work quiet = work;
  quiet.progress = {};
  return [options, field = std::move(field), frame_numbers = std::move(frame_numbers), take = std::move(take),
          quiet = std::move(quiet), shown = std::numeric_limits<double>::infinity()](
             const ModelStep& step, const Mesh& surface) mutable {
    // The first, quick model is better than a guess of the depth.
    const bool guessed = step.kind == ModelStep::Kind::segments;
    if (guessed || !step.taken || step.error > (1.0 - options.least_gain) * shown) return;
    auto made = field_from_corrected_shapes(surface, {}, field, quiet);
    if (!made) return;
    shown = step.error;
    const double error_m = made->scene.scene_from_input.scale * step.error;
    made->notes = {Note(growth_sentence(step, frame_numbers.at(step.map), error_m))};
    take(*std::move(made));
  };
}

}  // namespace palpable::recipes
