// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <array>
#include <map>
#include <string>

#include "stereo_scenes.hpp"

// Whether a confidence tells the truth: of the pixels with a confidence in each bin, the share that is right.
namespace palpable::bench {

class Reliability {
 public:
  /// Right: within 1 px of the truth, of all pixels of the scene. Nothing if there is no confidence.
  void add(const StereoScene& scene, const Raster<float>& disparity_px, const Raster<float>& confidence);
  /// A table of the bins over all scenes, and a row for each kind: the share of pixels of at least 0.9 and
  /// how many of them are right, the same for those below 0.5, and the share of all that is right; percent.
  std::string table() const;

 private:
  static constexpr std::array<float, 6> kFrom{0.0F, 0.1F, 0.3F, 0.5F, 0.7F, 0.9F};
  struct Bin {
    long pixels = 0;
    long right = 0;
  };
  using Bins = std::array<Bin, kFrom.size()>;

  static Bin sum(const Bins& bins, std::size_t begin, std::size_t end);

  std::map<SceneKind, Bins> by_kind_;
};

}  // namespace palpable::bench
