// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/vertical_offsets.hpp"

#include "palpable/core/numbers/median.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>

namespace palpable::vision {
namespace {

/// The first of the four control values at a coordinate, and their weights, for a uniform cubic B-spline over
/// [0, 1] with `count` control values.
struct Basis {
  int first = 0;
  std::array<double, 4> weights{};
};

Basis basis_at(double place, int count) {
  const int spans = count - 3;
  const double s = std::clamp(place, 0.0, 1.0) * spans;
  Basis out;
  out.first = std::min(static_cast<int>(s), spans - 1);
  const double t = s - out.first, u = 1.0 - t;
  out.weights = {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
                 (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0, t * t * t / 6.0};
  return out;
}

template <class Visit>
void visit_controls(double x, double y, int across, int down, const Visit& visit) {
  const Basis bx = basis_at(x, across), by = basis_at(y, down);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      visit((by.first + static_cast<int>(j)) * across + bx.first + static_cast<int>(i),
            by.weights[j] * bx.weights[i]);
}

/// Adds the smoothness term: squared second differences of the control values along both axes.
void add_smoothness(cv::Mat_<double>& normal, int across, int down, double weight) {
  const auto add = [&](int a, int b, int c) {
    const std::array<std::pair<int, double>, 3> terms{{{a, 1.0}, {b, -2.0}, {c, 1.0}}};
    for (const auto& [i, f] : terms)
      for (const auto& [j, g] : terms) normal(i, j) += weight * f * g;
  };
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      const int at = j * across + i;
      if (i > 0 && i + 1 < across) add(at - 1, at, at + 1);
      if (j > 0 && j + 1 < down) add(at - across, at, at + across);
    }
}

}  // namespace

std::optional<VerticalOffsets> VerticalOffsets::through(const std::vector<FeatureMatch>& matches, int width,
                                                        int height, const VerticalOffsetOptions& options) {
  const int across = options.controls_across, down = options.controls_down, controls = across * down;
  if (matches.size() < static_cast<std::size_t>(options.least_matches)) return std::nullopt;
  VerticalOffsets rows(width, height, across, down);
  std::vector<double> offsets;
  for (const FeatureMatch& m : matches) offsets.push_back(m.right_y - m.left_y);
  const double middle = median_of(offsets);
  for (double& v : offsets) v = std::abs(v - middle);
  // A B-spline's weights sum to 1, so equal control values give a constant surface.
  rows.control_.assign(static_cast<std::size_t>(controls), middle);
  for (double scale_px = std::max(options.first_scale_px, 3.0 * median_of(offsets));
       scale_px > options.last_scale_px; scale_px *= options.scale_factor) {
    cv::Mat_<double> normal(controls, controls, 0.0);
    cv::Mat_<double> right(controls, 1, 0.0);
    for (const FeatureMatch& m : matches) {
      const double offset = m.right_y - m.left_y;
      const double r = (offset - rows.offset_px(m.right_x, m.left_y)) / scale_px;
      const double weight = 1.0 / ((1.0 + r * r) * (1.0 + r * r));
      visit_controls(m.right_x / width, m.left_y / height, across, down, [&](int i, double f) {
        right(i) += weight * f * offset;
        visit_controls(m.right_x / width, m.left_y / height, across, down,
                       [&](int j, double g) { normal(i, j) += weight * f * g; });
      });
    }
    add_smoothness(normal, across, down, options.smoothness);
    cv::Mat_<double> solved;
    if (!cv::solve(normal, right, solved, cv::DECOMP_CHOLESKY)) return std::nullopt;
    rows.control_.assign(solved.begin(), solved.end());
  }
  return rows;
}

double VerticalOffsets::offset_px(double x, double y) const {
  double sum = 0.0;
  visit_controls(x / width_, y / height_, across_, down_,
                 [&](int i, double f) { sum += f * control_[static_cast<std::size_t>(i)]; });
  return sum;
}

FeatureMatch VerticalOffsets::corrected(const FeatureMatch& match) const {
  FeatureMatch out = match;
  out.right_y -= offset_px(match.right_x, match.left_y);
  return out;
}

bool VerticalOffsetScore::is_better_than(std::size_t other_inliers, double other_px,
                                         const VerticalOffsetOptions& options) const {
  const bool more = static_cast<double>(inliers) > options.more_matches * static_cast<double>(other_inliers);
  const bool closer = inliers >= other_inliers && other_px > options.good_residual_px &&
                      residual_px < options.less_residual * other_px;
  return greatest_px > options.least_offset_px && (more || closer);
}

VerticalOffsetScore cross_validate_offsets(const std::vector<FeatureMatch>& matches, int width, int height,
                                           double tolerance_px, const VerticalOffsetOptions& options) {
  std::array<std::vector<FeatureMatch>, 2> halves;
  for (std::size_t i = 0; i < matches.size(); ++i) halves[i % 2].push_back(matches[i]);
  VerticalOffsetScore score;
  std::vector<FeatureMatch> inliers;
  std::vector<double> offsets;
  for (const std::size_t half : {0U, 1U}) {
    const auto rows = VerticalOffsets::through(halves[1 - half], width, height, options);
    if (!rows) return {};
    for (const FeatureMatch& m : halves[half]) {
      const FeatureMatch corrected = rows->corrected(m);
      if (!(std::abs(corrected.right_y - corrected.left_y) <= tolerance_px)) continue;
      inliers.push_back(corrected);
      offsets.push_back(m.right_y - corrected.right_y);
    }
  }
  if (inliers.empty()) return score;
  score.inliers = inliers.size();
  score.residual_px = vertical_rms_px(inliers);
  const double middle = median_of(offsets);
  for (const double offset : offsets)
    score.greatest_px = std::max(score.greatest_px, std::abs(offset - middle));
  return score;
}

}  // namespace palpable::vision
