// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/walk.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace palpable::session {

Transform<SceneFrame, ExplorerFrame> scene_from_explorer(const ExplorerPose& pose) {
  const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
  Transform<SceneFrame, ExplorerFrame> transform;
  transform.rotation = {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0};
  transform.translation_m = {pose.x_m, pose.y_m, 0.0};
  return transform;
}

Transform<SceneFrame, DeviceFrame> with_explorer(const Transform<SceneFrame, DeviceFrame>& laid_out,
                                                 const ExplorerPose& pose) {
  Transform<SceneFrame, DeviceFrame> place = laid_out;
  place.rotation = scene_from_explorer(pose).rotation;
  place.translation_m = {pose.x_m, pose.y_m, laid_out.translation_m.z};
  return place;
}

std::size_t steps_by(std::span<const WalkStep> walk, double t_s) {
  const auto later = std::upper_bound(walk.begin(), walk.end(), t_s,
                                      [](double t, const WalkStep& step) { return t < step.t_s; });
  return static_cast<std::size_t>(later - walk.begin());
}

const ExplorerPose& pose_at(std::span<const WalkStep> walk, double t_s) {
  return walk[std::max<std::size_t>(steps_by(walk, t_s), 1) - 1].pose;
}

Result<void> check_walk(std::span<const WalkStep> walk) {
  if (walk.empty()) return invalid_input("the walk has no steps");
  constexpr double kFarthest_m = 1000.0;
  for (std::size_t i = 0; i < walk.size(); ++i) {
    const ExplorerPose& s = walk[i].pose;
    if (!std::isfinite(walk[i].t_s) || !std::isfinite(s.heading_rad) ||
        !(std::hypot(s.x_m, s.y_m) <= kFarthest_m))
      return invalid_input(
          fmt::format("step {} is not finite or farther than 1000 m from the middle", i + 1));
    if (i > 0 && !(walk[i].t_s > walk[i - 1].t_s))
      return invalid_input(fmt::format("step {} is not later than the one before", i + 1));
  }
  return {};
}

std::string words_of(const ExplorerPose& pose) {
  constexpr double kHere_m = 0.0005;
  std::vector<std::string> parts;
  if (std::abs(pose.x_m) >= kHere_m)
    parts.push_back(describe::phrase(pose.x_m > 0.0 ? "{} right of" : "{} left of",
                                     describe::spoken_length(std::abs(pose.x_m))));
  if (std::abs(pose.y_m) >= kHere_m)
    parts.push_back(describe::phrase(pose.y_m > 0.0 ? "{} above" : "{} below",
                                     describe::spoken_length(std::abs(pose.y_m))));
  return describe::phrase("You stand {} the middle, facing {}.",
                          parts.empty() ? describe::tr("in") : describe::listed(parts),
                          describe::heading_words(pose.heading_rad));
}

}  // namespace palpable::session
