// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

// Inside vision's sources only.
namespace palpable::vision {

struct PatchOptions {
  /// Side of the compared square, px, odd, 7 … 31.
  int window_px = 15;
  /// Standard deviation of the weights around its centre, share of the side.
  double weight_width = 0.4;
  /// How strongly the linear part keeps its last value, relative to what a patch of even texture says of it.
  double stiffness = 0.1;
  int most_iterations = 30;
  /// An alignment has converged if its last step moved the centre and the border by less than this, px.
  double least_step_px = 0.005, least_border_step_px = 0.015;
  /// The centre is at most this far from where the alignment began, px.
  double farthest_px = 4.0;
  /// Least share of the template's variance that the aligned patch explains.
  double least_likeness = 0.5;
};

/// Where a picture shows a patch: its centre at `centre`, and an offset u from the template's centre at
/// centre + linear * u.
struct PatchPlace {
  ImagePoint centre;
  /// Row-major.
  std::array<double, 4> linear{1, 0, 0, 1};
};

/// A square of a picture that is found again in others under an affine change of its shape and a linear one
/// of its brightness (Lucas & Kanade's method in the inverse compositional form of Baker & Matthews 2004:
/// derivatives of the template alone).
class PatchTemplate {
 public:
  /// `centre` may lie between pixels. The picture need not outlive it.
  PatchTemplate(const Raster<std::uint8_t>& picture, ImagePoint centre, const PatchOptions& options);

  /// False if the patch extends beyond the picture or has no texture; it cannot be aligned then.
  bool is_valid() const { return valid_; }
  /// Moves `place` to where `picture` shows the patch. False if that is too far away, too unlike or at the
  /// border; `place` is unspecified then.
  bool align(const Raster<std::uint8_t>& picture, PatchPlace& place) const;

 private:
  static constexpr std::size_t kMostSamples = std::size_t{31} * 31;
  /// Four of the linear part (row-major), two of the centre, brightness, contrast.
  static constexpr std::size_t kUnknowns = 8;
  using Samples = std::array<float, kMostSamples>;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

  void fill_offsets();
  bool sample(const Raster<std::uint8_t>& picture, const PatchPlace& place, int margin, Samples& out) const;
  void subtract_mean(Samples& values) const;
  void fill_derivatives(const Samples& across, const Samples& down);

  PatchOptions options_;
  std::size_t count_ = 0;
  Samples u_, v_, weight_;
  Samples values_;
  /// Times the weights.
  std::array<Samples, kUnknowns> derivatives_;
  Eigen::Matrix<double, kUnknowns, kUnknowns> inverse_;
  double weight_sum_ = 0.0, variance_ = 0.0;
  bool valid_ = false;
};

}  // namespace palpable::vision
