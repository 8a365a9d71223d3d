// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/result/confirming_points.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/rectification/any_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace palpable::vision {
namespace {

/// Whether any of the 3 x 3 pixels around the left point has the disparity: at a depth edge the nearest pixel
/// may belong to the other side.
bool agrees(const Raster<float>& map_px, const FeatureMatch& match, double disparity_px,
            double tolerance_px) {
  const int x0 = static_cast<int>(std::lround(match.left_x)),
            y0 = static_cast<int>(std::lround(match.left_y));
  for (int y = y0 - 1; y <= y0 + 1; ++y)
    for (int x = x0 - 1; x <= x0 + 1; ++x) {
      if (x < 0 || y < 0 || x >= map_px.width() || y >= map_px.height()) continue;
      if (std::fabs(static_cast<double>(map_px(x, y)) - disparity_px) <= tolerance_px) return true;
    }
  return false;
}

/// How far a match is off common rows, and its disparity.
struct OnRows {
  double off_row_px;
  double disparity_px;
};

OnRows on_rows_of(const FeatureMatch& m, const std::optional<EpipolarFrame>& frame) {
  if (!frame) return {m.left_y - m.right_y, m.left_x - m.right_x};
  const PicturePoint left = frame_from_picture(*frame, frame->transform.left, {m.left_x, m.left_y}),
                     right = frame_from_picture(*frame, frame->transform.right, {m.right_x, m.right_y});
  return {left.y - right.y, disparity_from_columns(*frame, {m.left_x, m.left_y}, left.x - right.x)};
}

/// What the rigid motion of the points says of the dense disparity.
void judge_motion(const StereoPair& pair, const std::vector<FeatureMatch>& matches,
                  const Raster<float>& disparity_px, ConfirmingPoints& out) {
  const int width = pair.left.width, height = pair.left.height;
  const auto motion =
      find_any_motion(matches, unknown_camera(width, height), feature_tolerance_px(width, height));
  if (!motion) return;
  std::vector<double> dense;
  std::vector<FeatureMatch> known;
  for (const FeatureMatch& m : motion->inliers) {
    const int x = std::clamp(static_cast<int>(std::lround(m.left_x)), 0, width - 1),
              y = std::clamp(static_cast<int>(std::lround(m.left_y)), 0, height - 1);
    const auto value = static_cast<double>(disparity_px(x, y));
    if (!std::isfinite(value)) continue;
    dense.push_back(value);
    known.push_back(m);
  }
  out.rigid = true;
  out.beyond_turn = motion->beyond_turn;
  out.certainty = motion->certainty;
  out.depth_order = order_agreement(depths_of(motion->model, known), dense);
}

}  // namespace

std::vector<Parameter> parameters_of(ConfirmingOptions& o) {
  return {{"row_px", &o.row_px, {0, 20}, "px", "tolerance of a point's row"},
          {"agree_px", &o.agree_px, {0, 20}, "px", "tolerance of a point's disparity"},
          {"on_plane_px", &o.on_plane_px, {0, 20}, "px", "tolerance of the dominant plane"}};
}

double share_off_plane(const std::vector<FeatureMatch>& matches, double on_plane_px) {
  if (matches.size() < 4) return 0.0;
  const auto row_of = [](const FeatureMatch& m) { return cv::Vec3d(m.left_x, m.left_y, 1.0); };
  const auto disparity_of = [](const FeatureMatch& m) { return m.left_x - m.right_x; };
  std::vector<double> off(matches.size(), 0.0);
  // Least squares, twice: the second time without the farthest third, which may be on other surfaces.
  double most = 0.0;
  for (int round = 0; round < 2; ++round) {
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right(0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (off[i] > most) continue;
      normal += cv::Matx31d(row_of(matches[i])) * cv::Matx31d(row_of(matches[i])).t();
      right += disparity_of(matches[i]) * row_of(matches[i]);
    }
    const cv::Vec3d plane = normal.solve(right, cv::DECOMP_SVD);
    for (std::size_t i = 0; i < matches.size(); ++i)
      off[i] = std::fabs(disparity_of(matches[i]) - plane.dot(row_of(matches[i])));
    std::vector<double> sorted = off;
    most = quantile_of(sorted, 2.0 / 3.0);
  }
  const auto beyond =
      std::count_if(off.begin(), off.end(), [on_plane_px](double px) { return px > on_plane_px; });
  return static_cast<double>(beyond) / static_cast<double>(off.size());
}

ConfirmingPoints confirming_points(const StereoPair& pair, const Raster<float>& disparity_px,
                                   const ConfirmingOptions& options) {
  const double row_px = options.row_px + feature_tolerance_px(pair.left.width, pair.left.height);
  ConfirmingPoints out;
  int on_rows = 0;
  std::vector<double> confirmed;
  std::vector<FeatureMatch> confirmed_matches;
  const std::vector<FeatureMatch> matches = match_features(pair);
  for (const FeatureMatch& match : matches) {
    ++out.count;
    const OnRows point = on_rows_of(match, pair.frame);
    if (std::fabs(point.off_row_px) > row_px) continue;
    ++on_rows;
    if (!agrees(disparity_px, match, point.disparity_px, options.agree_px)) continue;
    confirmed.push_back(point.disparity_px);
    confirmed_matches.push_back(
        {match.left_x, match.left_y, match.left_x - point.disparity_px, match.left_y});
  }
  if (out.count == 0) return out;
  out.on_rows = static_cast<double>(on_rows) / out.count;
  out.confirmed = static_cast<double>(confirmed.size()) / out.count;
  if (!confirmed.empty()) out.range_px = quantile_of(confirmed, 0.95) - quantile_of(confirmed, 0.05);
  out.off_plane = share_off_plane(confirmed_matches, options.on_plane_px);
  judge_motion(pair, matches, disparity_px, out);
  return out;
}

}  // namespace palpable::vision
