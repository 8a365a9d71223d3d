// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_memory.hpp"

#include "palpable/vision/mapping/map_view.hpp"
#include "palpable/vision/mapping/view_warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpable::session {
namespace {

/// What was seen at most this long ago has this name.
struct Age {
  double most_s;
  const char* name;
};
constexpr std::array kAges{
    Age{5.0, "memory, seen a few seconds ago"}, Age{20.0, "memory, seen about 10 seconds ago"},
    Age{45.0, "memory, seen about 30 seconds ago"}, Age{120.0, "memory, seen about a minute ago"},
    Age{HUGE_VAL, "memory, seen minutes ago"}};

Pinhole assumed_camera(int width, int height, double view_rad) {
  const double f = width / 2.0 / std::tan(view_rad / 2.0);
  return {f, f, (width - 1) / 2.0, (height - 1) / 2.0, width, height};
}

/// Whether a surface 1 m away moves by less than half a pixel: the uncertainty of a pose, which must not make
/// the picture of a camera at rest tremble.
bool is_same_view(const Transform<CameraFrame, CameraFrame>& view_from_camera, const Pinhole& camera) {
  const double most = 0.5 / camera.fx;
  const auto& r = view_from_camera.rotation;
  const double turn = 0.5 * norm(Vec3{r[7] - r[5], r[2] - r[6], r[3] - r[1]});
  return turn < most && norm(view_from_camera.translation_m) < most;
}

/// Whether pictures of `now` do not fit those of `before`; not if there was none.
bool is_another(const Pinhole& before, const Pinhole& now) {
  constexpr double kSame = 0.01;
  return before.width > 0 &&
         (before.width != now.width || before.height != now.height ||
          std::abs(before.fx - now.fx) > kSame * now.fx || std::abs(before.fy - now.fy) > kSame * now.fy);
}

}  // namespace

std::vector<models::Material> memory_materials() {
  std::vector<models::Material> materials(1);
  for (const Age& age : kAges) {
    models::Material material;
    material.name = age.name;
    // A fine grain tells memory from what is seen now, whose material is smooth.
    material.texture.kind = models::TouchTexture::Kind::grain;
    material.texture.pitch_m = 0.0015;
    material.texture.height_m = 40e-6;
    materials.push_back(std::move(material));
  }
  return materials;
}

std::uint8_t memory_label(double age_s) {
  std::uint8_t label = 1;
  for (const Age& age : kAges) {
    if (age_s <= age.most_s) return label;
    ++label;
  }
  return kAges.size();
}

Raster<float> LiveMemory::live_view(const LiveFrame& frame, const Raster<float>& depth_m, int reduction,
                                    double time_s) {
  const double dt_s = std::max(0.0, time_s - std::exchange(time_s_, time_s));
  const Raster<float>& raw = frame.depth.depth_m;
  const Pinhole whole =
      frame.depth.camera.value_or(assumed_camera(raw.width(), raw.height(), options_.assumed_view_rad));
  const Pinhole before = std::exchange(camera_, vision::reduced_camera(whole, reduction));
  // A map that was made with another camera is bent, as with an assumed one before the true one came.
  if (is_another(before, camera_)) memory_ = vision::CameraMemory(options_.camera);
  depth_m_ = depth_m;
  pose_ = memory_.locate(depth_m, camera_, frame.world_from_camera);
  if (!pose_) {
    ++lost_;
    return depth_m;
  }
  view_pose_ = view_.add(*pose_, dt_s);
  const auto view_from_camera = view_pose_.inverse() * *pose_;
  if (is_same_view(view_from_camera, camera_)) return depth_m;
  return vision::seen_from(depth_m, camera_, view_from_camera, camera_);
}

Raster<std::uint8_t> LiveMemory::fill(Raster<float>& depth_m) {
  Raster<std::uint8_t> labels(depth_m.width(), depth_m.height(), 0);
  if (!pose_) return labels;
  const auto remembered = vision::view_of(memory_.map(), view_pose_, camera_, depth_m);
  std::size_t filled = 0;
  for (std::size_t k = 0; k < depth_m.count(); ++k) {
    const float z = remembered.depth_m.values()[k];
    if (!std::isfinite(z)) continue;
    depth_m.values()[k] = z;
    labels.values()[k] = memory_label(time_s_ - static_cast<double>(remembered.seen_s.values()[k]));
    ++filled;
  }
  remembered_share_ = static_cast<double>(filled) / static_cast<double>(depth_m.count());
  return labels;
}

void LiveMemory::learn() {
  if (pose_) memory_.add(depth_m_, camera_, *pose_, time_s_);
}

}  // namespace palpable::session
