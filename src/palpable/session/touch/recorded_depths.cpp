// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_depths.hpp"

#include "palpable/core/files/atomic_files.hpp"
#include "palpable/formats/picture/png.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetre_m = 0.001, kTenth_m = 0.0001;

/// The unit in which these depths are written.
double unit_for(const Raster<float>& depth_m) {
  constexpr double kFarthest_m = 6.5, kRounding = 0.002;
  const auto& values = depth_m.values();
  const bool fits_tenths =
      std::none_of(values.begin(), values.end(), [](float z) { return std::isfinite(z) && z > kFarthest_m; });
  const bool is_whole = std::all_of(values.begin(), values.end(), [](float z) {
    const double units = double{z} / kMillimetre_m;
    return !std::isfinite(z) || std::abs(units - std::round(units)) < kRounding;
  });
  return fits_tenths && !is_whole ? kTenth_m : kMillimetre_m;
}

Raster<std::uint16_t> units_of(const Raster<float>& depth_m, double metres_per_unit) {
  constexpr double kMost = 65535.0;
  Raster<std::uint16_t> units(depth_m.width(), depth_m.height());
  std::transform(depth_m.values().begin(), depth_m.values().end(), units.data(), [&](float z) {
    const double count = std::round(double{z} / metres_per_unit);
    return count >= 1.0 && count <= kMost ? static_cast<std::uint16_t>(count) : std::uint16_t{0};
  });
  return units;
}

std::string sidecar_of(const std::optional<Pinhole>& camera, double metres_per_unit) {
  nlohmann::json stated{{"meaning", "depth"}, {"metres_per_unit", metres_per_unit}};
  if (camera) {
    stated["fx"] = camera->fx, stated["fy"] = camera->fy, stated["cx"] = camera->cx;
    stated["cy"] = camera->cy, stated["width"] = camera->width, stated["height"] = camera->height;
  }
  return stated.dump() + "\n";
}

std::string pose_text(const Transform<WorldFrame, palpable::CameraFrame>& pose) {
  const auto& r = pose.rotation;
  const Vec3& t = pose.translation_m;
  return fmt::format("{} {} {} {}\n{} {} {} {}\n{} {} {} {}\n0 0 0 1\n", r[0], r[1], r[2], t.x, r[3], r[4],
                     r[5], t.y, r[6], r[7], r[8], t.z);
}

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

struct Kept {
  LiveFrame frame;
  std::optional<Image> colour;
  double metres_per_unit = kMillimetre_m;
  bool has_sidecar = false;
};

Result<void> write_frame(const fs::path& folder, const Kept& kept) {
  AtomicFiles files;
  const auto add = [&](const std::string& name, std::span<const std::byte> bytes) {
    return files.add(folder / name, bytes);
  };
  const auto number = fmt::format("{:06}", kept.frame.number);
  if (kept.has_sidecar)
    if (auto added = add("depth.json", bytes_of(sidecar_of(kept.frame.depth.camera, kept.metres_per_unit)));
        !added)
      return added;
  const auto depth = formats::encode_png(units_of(kept.frame.depth.depth_m, kept.metres_per_unit));
  if (!depth) return depth.error();
  if (auto added = add(number + ".depth.png", *depth); !added) return added;
  if (kept.colour) {
    const auto colour = formats::encode_png(*kept.colour);
    if (!colour) return colour.error();
    if (auto added = add(number + ".color.png", *colour); !added) return added;
  }
  if (const auto& pose = kept.frame.world_from_camera)
    if (auto added = add(number + ".pose.txt", bytes_of(pose_text(*pose))); !added) return added;
  return files.commit();
}

}  // namespace

Result<std::unique_ptr<DepthRecorder>> DepthRecorder::open(const fs::path& folder) {
  auto recorder = FrameRecorder::open(folder);
  if (!recorder) return std::move(recorder).error();
  return std::unique_ptr<DepthRecorder>(new DepthRecorder(folder, *std::move(recorder)));
}

void DepthRecorder::keep(const LiveFrame& frame, const std::optional<Image>& colour) {
  if (metres_per_unit_ == 0.0) metres_per_unit_ = unit_for(frame.depth.depth_m);
  // A camera may be stated only after the first frames, as by a rosbridge server.
  const bool has_camera = frame.depth.camera.has_value();
  const bool has_sidecar = !has_written_ || (has_camera && !has_stated_camera_);
  const bool is_kept =
      recorder_->keep([folder = folder_, kept = Kept{frame, colour, metres_per_unit_, has_sidecar}] {
        return write_frame(folder, kept);
      });
  has_written_ = has_written_ || is_kept;
  has_stated_camera_ = has_stated_camera_ || (is_kept && has_camera);
}

}  // namespace palpable::session
