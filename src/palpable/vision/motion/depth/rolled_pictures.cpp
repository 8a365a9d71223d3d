// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/rolled_pictures.hpp"

#include "palpable/vision/motion/depth/plane_sweep.hpp"
#include "palpable/vision/motion/structure/bundle.hpp"
#include "palpable/vision/motion/tracks/polynomial_derivatives.hpp"
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

// The camera of a frame at a time after its middle, in the frame of the camera there.
class MovingCamera {
 public:
  MovingCamera(const CameraMotion& motion, int frame, std::span<const int> frame_numbers) {
    const auto pose_of = [&](int k) -> const auto& { return motion.poses[static_cast<std::size_t>(k)]; };
    const NodeFrames nodes = node_frames(frame, frame_numbers, [&](int k) { return pose_of(k).has_value(); });
    std::array<std::array<double, kMostNodes>, 6> values{};
    for (std::size_t i = 0; i < nodes.count; ++i) {
      const auto between = pose_of(frame)->inverse() * *pose_of(nodes.frames[i]);
      const BundlePose pose = bundle_pose({between.rotation, between.translation_m});
      for (std::size_t p = 0; p < pose.size(); ++p) values[p][i] = pose[p];
    }
    for (std::size_t p = 0; p < values.size(); ++p)
      derivatives_[p] =
          derivatives_at_zero({nodes.times.data(), nodes.count}, {values[p].data(), nodes.count});
  }

  CameraPose at(double time) const {
    BundlePose pose{};
    for (std::size_t p = 0; p < pose.size(); ++p)
      pose[p] = time * derivatives_[p].first + time * time / 2 * derivatives_[p].second;
    return camera_pose(pose);
  }

 private:
  std::array<Derivatives, 6> derivatives_{};
};

// A point of the structure in a frame: its pixel and the inverse of its depth.
struct SeenDepth {
  double x = 0.0, y = 0.0, inverse_depth = 0.0;
};

std::vector<SeenDepth> seen_depths(const CameraMotion& motion, int frame) {
  const auto camera_from_world = motion.poses[static_cast<std::size_t>(frame)]->inverse();
  const Pinhole& camera = motion.camera;
  std::vector<SeenDepth> out;
  for (const StructurePoint& point : motion.points) {
    const Vec3 p = (camera_from_world * point.position).v;
    if (p.z <= 0) continue;
    const double x = camera.fx * p.x / p.z + camera.cx, y = camera.fy * p.y / p.z + camera.cy;
    if (x > -0.5 && y > -0.5 && x < camera.width - 0.5 && y < camera.height - 0.5)
      out.push_back({x, y, 1 / p.z});
  }
  return out;
}

// Every kCell-th pixel of the inverse depth, with one beyond the right and lower border.
constexpr int kCell = 16;

// A plane's inverse depth is linear in the picture. The points' differences from it are averaged with weights
// that fall with the fourth power of the distance.
Raster<float> inverse_depths(const std::vector<SeenDepth>& seen, const Pinhole& camera) {
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const SeenDepth& s : seen) {
    const Eigen::Vector3d row(s.x / camera.width, s.y / camera.height, 1);
    normal += row * row.transpose(), right += s.inverse_depth * row;
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  const auto on_plane = [&](double x, double y) {
    return plane[0] * x / camera.width + plane[1] * y / camera.height + plane[2];
  };
  Raster<float> out(camera.width / kCell + 2, camera.height / kCell + 2);
  for (int v = 0; v < out.height(); ++v)
    for (int u = 0; u < out.width(); ++u) {
      const double x = u * kCell, y = v * kCell;
      double sum = 0.0, weights = 1e-12;
      for (const SeenDepth& s : seen) {
        const double d = (s.x - x) * (s.x - x) + (s.y - y) * (s.y - y) + kCell * kCell;
        const double weight = 1 / (d * d);
        sum += weight * (s.inverse_depth - on_plane(s.x, s.y)), weights += weight;
      }
      out(u, v) = static_cast<float>(std::max(0.0, on_plane(x, y) + sum / weights));
    }
  return out;
}

double interpolated(const Raster<float>& cells, int x, int y) {
  const int u = x / kCell, v = y / kCell;
  const float a = static_cast<float>(x % kCell) / kCell, b = static_cast<float>(y % kCell) / kCell;
  return static_cast<double>((1 - b) * ((1 - a) * cells(u, v) + a * cells(u + 1, v)) +
                             b * ((1 - a) * cells(u, v + 1) + a * cells(u + 1, v + 1)));
}

}  // namespace

Raster<Rgb8> without_rolling_shutter(const Raster<Rgb8>& picture, const CameraMotion& motion, int frame,
                                     std::span<const int> frame_numbers) {
  const Readout& readout = motion.readout;
  if (readout == Readout{}) return picture;
  const Pinhole& camera = motion.camera;
  const Raster<float> cells = inverse_depths(seen_depths(motion, frame), camera);
  const MovingCamera moving(motion, frame, frame_numbers);
  // Where pixels are at the beginning and end of the readout; between, on the parabola.
  const double end = 0.5 * (std::abs(readout.rows) + std::abs(readout.columns));
  const PosedFrame now{nullptr, {}};
  const EpipolarLine earlier(now, {nullptr, moving.at(-end)}, camera),
      later(now, {nullptr, moving.at(end)}, camera);
  cv::Mat places(picture.height(), picture.width(), CV_32FC2);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const double inverse_depth = interpolated(cells, x, y);
      const auto a = earlier.place(x, y, inverse_depth), b = later.place(x, y, inverse_depth);
      const ImagePoint at =
          reading_place({static_cast<double>(x), static_cast<double>(y)}, picture.width(), picture.height());
      const double t = (readout.rows * at.y + readout.columns * at.x) / end;
      const auto moved = [&](double from, double before, double after) {
        return static_cast<float>(from + t / 2 * (after - before) + t * t / 2 * (before + after - 2 * from));
      };
      places.at<cv::Vec2f>(y, x) = {moved(x, a[0], b[0]), moved(y, a[1], b[1])};
    }
  Raster<Rgb8> out(picture.width(), picture.height());
  const cv::Mat from(picture.height(), picture.width(), CV_8UC3, const_cast<Rgb8*>(picture.data()));
  cv::Mat to(picture.height(), picture.width(), CV_8UC3, out.data());
  cv::remap(from, to, places, {}, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return out;
}

}  // namespace palpable::vision
