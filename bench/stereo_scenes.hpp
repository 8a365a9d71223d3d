// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Rendered stereo scenes with exact disparities, on which the parameters of the stereo methods are chosen. No
// test uses them. docs/stereo.md says which seeds.
namespace palpable::bench {

/// The difficulty of a scene.
enum class SceneKind {
  slanted,
  curved,
  rods,
  dark_edges,
  repeated,
  plain,
  foliage,
  hidden,
  exposure,
  noise,
  vertical,
  sharpened,
  interior,
  blank,
  plain_boards,
  faint,
  unrelated
};
/// The kinds of the tuning set, first.
inline constexpr int kSceneKinds = 13;
/// With those that only the confidence is calibrated on: most of their depth cannot be measured.
/// `unrelated`: the right picture shows another room, so that a disparity is right by chance only.
inline constexpr int kAllSceneKinds = 17;
std::string_view name_of(SceneKind kind);

struct StereoScene {
  std::string name;
  SceneKind kind{};
  vision::StereoPair pair;
  /// The left picture's disparity at each pixel's centre; px.
  Raster<float> truth_px;
  /// 1 if the right picture shows the same point of the same surface.
  Raster<std::uint8_t> seen_by_both;
};

/// Renders one scene of 320 x 240 pixels. Deterministic.
StereoScene render_scene(SceneKind kind, std::uint32_t seed);

/// The tuning set: the seeds 1 … seeds_per_kind of every kind.
std::vector<StereoScene> tuning_set(int seeds_per_kind);

/// The scenes that the confidence is calibrated or judged on: the seeds `first` … `last` of all kinds.
std::vector<StereoScene> confidence_set(int first, int last);

}  // namespace palpable::bench
