// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/depth_camera/depth_noise.hpp"
#include "palpable/vision/depth_camera/head_fit.hpp"

#include <optional>
#include <vector>

namespace palpable::vision {

struct HeadFinderOptions {
  /// Heads are looked for between these depths, m.
  double near_m = 0.25, far_m = 2.5;
  HeadShape shape;
  DepthNoise noise;
};

/// The head that is followed.
struct FoundHead {
  /// The middle between its eyes, if it faces the camera.
  Point<LevelFrame> eyes;
  /// How many heads there were when the whole picture was searched last, at least 1.
  int heads = 1;
};

/// Finds a viewer's head in the pictures of a depth camera that looks at the viewer, about upright: what is
/// round, of a head's size, free above and beside it, and above shoulders. At first it is the nearest head,
/// then the one nearest to the last place. By geometry alone: no colours, nothing learned, and nothing of a
/// picture is kept. One thread.
class HeadFinder {
 public:
  explicit HeadFinder(const HeadFinderOptions& options = {}) : options_(options) {}

  /// `depth_m` has the pinhole's size. nullopt: there is no head in the picture.
  std::optional<FoundHead> find(const Raster<float>& depth_m, const DownwardCamera& camera);

 private:
  std::optional<HeadFit> follow(const Raster<float>& depth_m, const DownwardCamera& camera) const;
  std::vector<HeadFit> search(const Raster<float>& depth_m, const DownwardCamera& camera) const;

  HeadFinderOptions options_;
  /// Where it was in the last picture; nullopt: nowhere.
  std::optional<HeadFit> last_;
  int pictures_ = 0;
  int heads_ = 0;
};

}  // namespace palpable::vision
