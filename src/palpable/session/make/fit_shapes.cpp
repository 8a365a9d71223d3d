// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/fit_shapes.hpp"

#include "palpable/session/make/places.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/solid/points_file.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace palpable::session {
namespace {

/// What was seen, and from where.
struct Seen {
  std::vector<Vec3> points_m;
  std::vector<std::uint8_t> labels;
  std::optional<Point<SceneFrame>> eye;
  std::vector<std::string> notes;
};

/// The places of a depth map's pixels; the camera stands in the origin and looks along -z, y up.
Result<Seen> seen_by(const DepthMap& depth, const std::filesystem::path& labels) {
  if (!depth.camera)
    return invalid_input("states no camera, without which its depth has no width: give --calibration");
  const Pinhole& camera = *depth.camera;
  const auto& metres = depth.depth_m;
  std::optional<Raster<float>> label_of;
  if (!labels.empty()) {
    auto read = sources::read_raster(labels);
    if (!read) return read.error();
    if (read->width() != metres.width() || read->height() != metres.height())
      return invalid_input("has another size than the depth map", labels.string());
    label_of = *std::move(read);
  }
  Seen seen;
  seen.eye = Point<SceneFrame>{};
  for (int y = 0; y < metres.height(); ++y)
    for (int x = 0; x < metres.width(); ++x) {
      const auto z = static_cast<double>(metres(x, y));
      if (!std::isfinite(z) || z <= 0.0) continue;
      const float label = label_of ? (*label_of)(x, y) : 1.0F;
      if (!(label >= 1.0F && label <= 255.0F)) continue;
      seen.points_m.push_back({z * (x - camera.cx) / camera.fx, -z * (y - camera.cy) / camera.fy, -z});
      if (label_of) seen.labels.push_back(static_cast<std::uint8_t>(label));
    }
  return seen;
}

Result<Seen> seen_in_depth(const MakeOptions& options, const sources::Input& input,
                           const std::filesystem::path& labels) {
  sources::DepthSettings settings = options.depth;
  if (!options.calibration.empty()) {
    const auto calibration = sources::read_calibration(options.calibration);
    if (!calibration) return calibration.error();
    settings.camera = sources::pinhole_of(calibration->left);
  }
  auto read = sources::read_depth_picture(input.files, settings);
  if (!read) return read.error();
  const auto* metres = std::get_if<DepthMap>(&read->depth);
  if (metres == nullptr)
    return invalid_input("holds no metres, only what is nearer and farther", input.files.back().string());
  auto seen = seen_by(*metres, labels);
  if (!seen) return at_place(seen.error(), input.files.back());
  seen->notes = std::move(read->notes);
  return seen;
}

Result<Seen> seen_by_pair(const MakeOptions& options, const std::filesystem::path& labels, const Work& work) {
  const auto pair = read_stereo_pair(
      {options.inputs, options.calibration, options.layout, options.rectification, options.moved_m}, work);
  if (!pair) return pair.error();
  // Told before the pair is matched, which takes seconds.
  if (!pair->pair.rig)
    return invalid_input("is a pair of unknown cameras, whose depth has no metres: give --calibration",
                         options.inputs.front().string());
  const auto match = vision::match_confirmed(pair->pair, options.method.value_or(default_method()),
                                             {options.max_disparity_px}, work);
  if (!match) return at_place(match.error(), options.inputs.front());
  const auto depth = depth_from_disparity(match->disparity);
  auto seen = seen_by(*depth, labels);
  if (!seen) return at_place(seen.error(), options.inputs.front());
  seen->notes = pair->notes;
  return seen;
}

Result<Seen> seen_in(const MakeOptions& options, const std::filesystem::path& labels, const Work& work) {
  const auto input = sources::recognise_input(options.inputs, options.kind);
  if (!input) return input.error();
  switch (input->kind) {
    case sources::InputKind::depth:
      return seen_in_depth(options, *input, labels);
    case sources::InputKind::stereo:
      return seen_by_pair(options, labels, work);
    case sources::InputKind::points: {
      if (!labels.empty())
        return Error{ErrorCode::usage, "points have no pixels that a label picture could name", "--labels"};
      auto cloud = sources::read_points(input->files.front());
      if (!cloud) return cloud.error();
      Seen seen;
      seen.points_m = std::move(cloud->places_m);
      return seen;
    }
    default:
      return Error{ErrorCode::usage,
                   "shapes are fitted to depth maps, pairs of calibrated cameras and points, not to a " +
                       std::string(sources::name_of(input->kind)),
                   input->files.front().string()};
  }
}

}  // namespace

Result<FittedShapes> fit_shapes(const MakeOptions& options, const std::filesystem::path& labels,
                                const sculpt::ShapeSetOptions& shapes, const Work& work) {
  auto seen = seen_in(options, labels, work);
  if (!seen) return seen.error();
  auto set = sculpt::fit_superquadrics(seen->points_m, seen->labels, seen->eye, shapes, work);
  if (!set) return at_place(set.error(), options.inputs.front());
  return FittedShapes{*std::move(set), seen->points_m.size(), std::move(seen->notes)};
}

}  // namespace palpable::session
