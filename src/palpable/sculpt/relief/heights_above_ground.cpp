// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/heights_above_ground.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/segmentation/ground_plane.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace palpable::sculpt {

std::vector<Parameter> parameters_of(FlattenOptions& o) {
  return {
      {"least_share", &o.least_share, {0, 1}, "", "share of samples on the ground"},
      {"most_under_share", &o.most_under_share, {0, 1}, "", "share of samples under it"},
      {"tolerance_share", &o.tolerance_share, {0.001, 0.5}, "", "tolerance over the relief's height"},
      {"most_bend", &o.most_bend, {0, 20}, "tolerances", "greatest distance of the ground from its plane"}};
}

namespace {

/// A plane plus a quadratic surface, over coordinates from -1 to 1.
class Ground {
 public:
  Ground(const vision::DisparityPlane& plane, const Raster<float>& values, double most_bend)
      : plane_(plane), half_x_(0.5 * values.width()), half_y_(0.5 * values.height()), most_bend_(most_bend) {}

  double at(int x, int y) const {
    return plane_.at(x, y) + std::clamp(terms_at(x, y).dot(bend_), -most_bend_, most_bend_);
  }
  /// Fits the quadratic surface to the values within `tolerance` of the current ground.
  void fit(const Raster<float>& values, double tolerance) {
    Matrix sums = Matrix::Zero();
    Terms right = Terms::Zero();
    // A sample of the many values is enough.
    const int step = std::max(1, std::max(values.width(), values.height()) / 512);
    for (int y = 0; y < values.height(); y += step)
      for (int x = 0; x < values.width(); x += step) {
        if (!(std::abs(values(x, y) - at(x, y)) <= tolerance)) continue;
        const Terms terms = terms_at(x, y);
        sums += terms * terms.transpose();
        right += (values(x, y) - plane_.at(x, y)) * terms;
      }
    // Ridge regression: terms that a narrow strip of ground does not determine stay near 0.
    constexpr double kLittle = 1e-4;
    sums.diagonal().array() += kLittle * std::max(1.0, sums(0, 0));
    bend_ = sums.ldlt().solve(right);
  }

 private:
  using Terms = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  Terms terms_at(int x, int y) const {
    const double u = (x - half_x_) / half_x_, v = (y - half_y_) / half_y_;
    Terms terms;
    terms << 1.0, u, v, u * u, u * v, v * v;
    return terms;
  }

  vision::DisparityPlane plane_;
  double half_x_, half_y_;
  double most_bend_;
  Terms bend_ = Terms::Zero();
};

}  // namespace

std::optional<Raster<float>> heights_above_ground(const models::Relief& relief, const Work& work,
                                                  const FlattenOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  const double range_m = relief.highest_m() - relief.lowest_m();
  if (!(range_m > 0.0)) return std::nullopt;
  // find_back_plane() has tolerances in pixels of disparity, so heights are scaled to its inlier tolerance.
  const vision::GroundPlaneOptions search;
  const double unit_m = options.tolerance_share * range_m / search.tolerance_px;
  Raster<float> scaled = relief.samples_m();
  for (float& z : scaled.values()) z = static_cast<float>(static_cast<double>(z) / unit_m);
  const auto found = vision::find_back_plane(scaled, work, search);
  if (!found) return std::nullopt;
  double on = 0.0, under = 0.0;
  for (int y = 0; y < scaled.height(); ++y)
    for (int x = 0; x < scaled.width(); ++x) {
      const double above = scaled(x, y) - found->plane.at(x, y);
      on += std::abs(above) <= search.tolerance_px ? 1.0 : 0.0;
      under += above < -2.0 * search.tolerance_px ? 1.0 : 0.0;
    }
  const auto all = static_cast<double>(scaled.count());
  if (on < options.least_share * all || under > options.most_under_share * all) return std::nullopt;
  Ground ground(found->plane, scaled, options.most_bend * search.tolerance_px);
  // With decreasing tolerances: at first the plane may deviate by the bend itself.
  for (const double tolerances : {4.0, 2.0, 1.0, 1.0})
    if (options.most_bend > 0.0) ground.fit(scaled, tolerances * search.tolerance_px);
  for (int y = 0; y < scaled.height(); ++y)
    for (int x = 0; x < scaled.width(); ++x)
      scaled(x, y) = static_cast<float>(std::max(0.0, (scaled(x, y) - ground.at(x, y)) * unit_m));
  return scaled;
}

}  // namespace palpable::sculpt
