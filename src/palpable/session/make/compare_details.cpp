// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/compare_details.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace palpable::session {
namespace {

/// The input of the detail operators: the depth after clipping and hole filling, almost without a slope
/// limit.
Result<Raster<float>> nearness_of(MakeOptions options, const Work& work) {
  options.recipes.relief.relief.detail = sculpt::DetailOperator::linear;
  options.recipes.relief.relief.sense = sculpt::Sense::raise;
  options.recipes.relief.relief.steepest_slope = 100.0;
  const auto made = make_scene(options, work);
  if (!made) return made.error();
  const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&made->scene.model);
  if (relief == nullptr)
    return Error{ErrorCode::usage, "detail operators are compared on what becomes a relief", {}};
  return (*relief)->samples_m();
}

Result<ComparedDetail> through(sculpt::DetailOperator detail, const Raster<float>& nearness,
                               sculpt::ReliefOptions options, const Work& work) {
  const auto [low, high] = std::minmax_element(nearness.values().begin(), nearness.values().end());
  options.far = double{*low};
  options.near = double{*high};
  options.detail = detail;
  const auto begin = std::chrono::steady_clock::now();
  auto relief = sculpt::relief_from_disparity({nearness, {}}, options, work);
  if (!relief) return relief.error();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  measure::ReliefScoreOptions scoring;
  scoring.compression = options.compression;
  scoring.steepest_slope = options.steepest_slope;
  scoring.scene_height_m = options.compression * double{*high};
  auto score = measure::score_relief(relief->samples_m(), relief->pixel_m(), nearness, scoring);
  if (!score) return score.error();
  return ComparedDetail{detail, *std::move(relief), *score, seconds.count()};
}

}  // namespace

Result<std::vector<ComparedDetail>> compare_details(const MakeOptions& options, const Work& work) {
  const auto nearness = nearness_of(options, work);
  if (!nearness) return nearness.error();
  sculpt::ReliefOptions relief = options.recipes.relief.relief;
  relief.sense = sculpt::Sense::raise;
  std::vector<ComparedDetail> compared;
  for (const sculpt::DetailOperator detail : sculpt::kDetailOperators) {
    auto one = through(detail, *nearness, relief, work);
    if (!one) return one.error();
    compared.push_back(*std::move(one));
  }
  return compared;
}

}  // namespace palpable::session
