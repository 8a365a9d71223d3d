// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "video_depth_figures.hpp"

#include "palpable/vision/image/luma.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::bench {
namespace {

using TruePose = Transform<measure::TrueWorldFrame, CameraFrame>;

Vec3 ray(const Pinhole& camera, int x, int y) {
  return {(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0};
}

bool has_texture_around(const Raster<std::uint8_t>& grey, int x, int y) {
  constexpr int kReach = 4;
  constexpr double kDeviation = 4.0;
  double sum = 0, squares = 0, count = 0;
  for (int v = std::max(0, y - kReach); v <= std::min(grey.height() - 1, y + kReach); ++v)
    for (int u = std::max(0, x - kReach); u <= std::min(grey.width() - 1, x + kReach); ++u) {
      const double level = grey(u, v);
      sum += level, squares += level * level, ++count;
    }
  return squares / count - sum * sum / (count * count) > kDeviation * kDeviation;
}

// The distance of a place from the true surface near the pixel that shows it; NaN outside the picture.
double distance_from_truth(const Raster<float>& truth, const Pinhole& camera, Vec3 place) {
  constexpr int kReach = 3;
  const double u = camera.fx * place.x / place.z + camera.cx, v = camera.fy * place.y / place.z + camera.cy;
  if (!(place.z > 0 && truth.contains(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)))))
    return std::nan("");
  double nearest = std::numeric_limits<double>::infinity();
  const int x0 = static_cast<int>(std::lround(u)), y0 = static_cast<int>(std::lround(v));
  for (int y = y0 - kReach; y <= y0 + kReach; ++y)
    for (int x = x0 - kReach; x <= x0 + kReach; ++x)
      if (truth.contains(x, y) && truth(x, y) > 0)
        nearest = std::min(nearest, norm(static_cast<double>(truth(x, y)) * ray(camera, x, y) - place));
  return std::isfinite(nearest) ? nearest : std::nan("");
}

struct Box {
  Vec3 least{1e9, 1e9, 1e9}, most{-1e9, -1e9, -1e9};
  void add(const Vec3& p) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
  }
};

double trimmed_rms(std::vector<double> distances) {
  std::sort(distances.begin(), distances.end());
  const std::size_t count = distances.size() - distances.size() / 50;
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) squares += distances[i] * distances[i];
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
}

}  // namespace

DepthFigures depth_figures(const std::vector<vision::FrameDepth>& maps,
                           const std::vector<Raster<Rgb8>>& pictures, const RenderedVideo& video,
                           const measure::CameraPathScore& path, const Work& work) {
  constexpr int kStructureStep_px = 8;
  double all = 0, known = 0, good = 0, textured = 0, good_textured = 0;
  std::vector<double> distances;
  Box box;
  const Pinhole& camera = video.camera();
  for (const vision::FrameDepth& map : maps) {
    const Raster<float> truth = video.depth(map.frame, work);
    const auto grey = vision::luma8(pictures[static_cast<std::size_t>(map.frame)]);
    const auto pose = video.pose(map.frame);
    const TruePose true_camera{pose.rotation, pose.translation_m, 1.0};
    for (int y = 0; y < truth.height(); ++y)
      for (int x = 0; x < truth.width(); ++x) {
        const double z = static_cast<double>(truth(x, y));
        if (!(z > 0)) continue;
        const bool sampled = x % kStructureStep_px == 0 && y % kStructureStep_px == 0;
        if (sampled) box.add((true_camera * Point<CameraFrame>{z * ray(camera, x, y)}).v);
        const bool has_texture = has_texture_around(grey, x, y);
        ++all, textured += has_texture ? 1 : 0;
        const double found = static_cast<double>(map.filled.depth_m(x, y));
        if (!(found > 0)) continue;
        const bool right = std::abs(path.true_from_found.scale * found / z - 1) < 0.01;
        ++known, good += right ? 1 : 0, good_textured += right && has_texture ? 1 : 0;
        if (!sampled || !(map.map.depth.depth_m(x, y) > 0)) continue;
        const double measured = static_cast<double>(map.map.depth.depth_m(x, y));
        const auto place =
            path.true_from_found * (map.map.pose * Point<CameraFrame>{measured * ray(camera, x, y)});
        const double distance = distance_from_truth(truth, camera, (true_camera.inverse() * place).v);
        if (distance >= 0) distances.push_back(distance);
      }
  }
  return {100 * known / all, 100 * good / all, 100 * good / known, 100 * good_textured / textured,
          100 * trimmed_rms(std::move(distances)) / norm(box.most - box.least)};
}

Raster<Rgb8> depth_errors_of(const vision::FrameDepth& map, const Raster<Rgb8>& picture,
                             const RenderedVideo& video, const measure::CameraPathScore& path,
                             const Work& work) {
  const Raster<float> truth = video.depth(map.frame, work);
  const auto grey = vision::luma8(picture);
  Raster<Rgb8> out(grey.width(), grey.height());
  for (int y = 0; y < grey.height(); ++y)
    for (int x = 0; x < grey.width(); ++x) {
      const std::uint8_t level = grey(x, y);
      out(x, y) = {level, level, level};
      const double z = static_cast<double>(truth(x, y));
      if (!(z > 0)) continue;
      const double error = path.true_from_found.scale * static_cast<double>(map.filled.depth_m(x, y)) / z - 1;
      const auto other =
          static_cast<std::uint8_t>(has_texture_around(grey, x, y) ? level / 3 : level / 2 + 64);
      if (std::isnan(error))
        out(x, y) = {other, other, 255};
      else if (std::abs(error) >= 0.01)
        out(x, y) = error > 0 ? Rgb8{255, other, other} : Rgb8{other, 255, other};
    }
  return out;
}

}  // namespace palpable::bench
