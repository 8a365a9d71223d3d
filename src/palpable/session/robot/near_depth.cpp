// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/near_depth.hpp"

#include "palpable/vision/image/reduced_picture.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"
#include "palpable/vision/stereo/methods/pair_sequence.hpp"

#include <utility>
#include <vector>

namespace palpable::session {
namespace {

/// Planes that face the camera, and, where all lines of sight meet them, level ones below it.
std::vector<vision::SweptPlanes> planes_for(const Transform<WorldFrame, CameraFrame>& pose,
                                            const Pinhole& camera, const NearDepthOptions& options) {
  std::vector<vision::SweptPlanes> planes{{options.near_m, options.far_m, {0, 0, 1}}};
  const Vec3 down = pose.inverse().rotate({0.0, 0.0, -1.0});
  // Nearly along them, a pixel would cover too much of a plane.
  constexpr double kLeastIncidence = 0.15;
  for (const int x : {0, camera.width - 1})
    for (const int y : {0, camera.height - 1}) {
      const Vec3 sight = unit(Vec3{(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0});
      if (dot(down, sight) < kLeastIncidence) return planes;
    }
  planes.push_back({options.near_m * down.z, options.far_m * down.z, down});
  return planes;
}

}  // namespace

Result<NearView> near_depth(std::span<const WristPicture> pictures, const Pinhole& camera,
                            const NearDepthOptions& options, const Work& work) {
  if (pictures.size() < 3) return invalid_input("the near view needs three pictures");
  for (const WristPicture& taken : pictures)
    if (taken.picture.width != camera.width || taken.picture.height != camera.height)
      return invalid_input("the wrist camera's pictures have another size than its camera_info states");
  Pinhole small = camera;
  std::vector<Raster<Rgb8>> reduced;
  std::vector<vision::PosedFrame> frames;
  reduced.reserve(pictures.size());
  for (const WristPicture& taken : pictures) {
    const auto fewer = vision::reduced(taken.picture, options.most_pixels);
    if (fewer) small = vision::scaled({camera}, static_cast<double>(fewer->width) / camera.width).left;
    if (fewer) small.height = fewer->height;
    reduced.push_back(rgb8(fewer ? *fewer : taken.picture));
    frames.push_back({&reduced.back(), taken.base_from_camera});
  }
  const std::size_t middle = pictures.size() / 2;
  std::vector<vision::PosedDepthMap> maps;
  for (const std::size_t reference : {middle, std::size_t{0}, pictures.size() - 1}) {
    std::vector<vision::PosedFrame> others = frames;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(reference));
    const auto& pose = frames[reference].pose;
    auto depth = vision::multi_view_depth(frames[reference], others, small, planes_for(pose, small, options),
                                          options.sweep, work);
    if (!depth) return std::move(depth).error();
    maps.push_back({*std::move(depth), pose});
  }
  auto agreed = vision::consistent_depth(maps, options.consistency, work);
  if (!agreed) return std::move(agreed).error();
  auto colour = vision::reduced(pictures[middle].picture, options.most_pixels);
  return NearView{std::move(agreed->front().depth), frames[middle].pose,
                  colour ? *std::move(colour) : pictures[middle].picture};
}

}  // namespace palpable::session
