// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/fit_shapes.hpp"

#include "palpable/session/make/places.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <optional>
#include <string>
#include <utility>

namespace palpable::session {
namespace {

using recipes::SeenPoints;

Result<SeenPoints> seen_in(const DepthMap& depth, const std::filesystem::path& labels) {
  std::optional<Raster<float>> label_of;
  if (!labels.empty() && depth.camera) {
    auto read = sources::read_raster(labels);
    if (!read) return read.error();
    label_of = *std::move(read);
  }
  auto seen = recipes::points_of_depth(depth, label_of);
  // With a known camera only the labels can be invalid.
  if (!seen && depth.camera) return at_place(seen.error(), labels);
  return seen;
}

/// Extracts points from the input's values.
struct SeenIn {
  const FitShapesOptions& options;
  const Work& work;

  Result<SeenPoints> operator()(const recipes::DepthInput& input) const {
    const auto* metres = std::get_if<DepthMap>(&input.depth);
    if (metres == nullptr) return invalid_input("has no metric scale, only relative depth");
    return seen_in(*metres, options.labels);
  }
  Result<SeenPoints> operator()(const ReadyPair& ready) const {
    // Checked before matching, which takes seconds.
    if (!ready.pair.rig)
      return invalid_input("is a pair from unknown cameras, whose depth has no metric scale",
                           options.input.files.front().string(), Reason::needs_calibration);
    const auto match = vision::match_confirmed(
        ready.pair, options.stereo.method.value_or(recipes::default_method()), options.stereo.options, work);
    if (!match) return match.error();
    return seen_in(*depth_from_disparity(match->disparity), options.labels);
  }
  Result<SeenPoints> operator()(PointCloud& cloud) const {
    if (!options.labels.empty()) return no_pixels("points have");
    SeenPoints seen;
    seen.points_m = std::move(cloud.places_m);
    return seen;
  }
  Result<SeenPoints> operator()(sources::MeshFile& file) const {
    if (!options.labels.empty()) return no_pixels("a mesh has");
    return recipes::points_of_mesh(std::move(file.mesh), work);
  }
  template <class Other>
  Result<SeenPoints> operator()(const Other& /*values*/) const {
    return Error{ErrorCode::usage,
                 "shapes are fitted to depth maps, pairs of calibrated cameras, points and meshes only",
                 {},
                 Reason::unexpected_input_kind};
  }

 private:
  Error no_pixels(const std::string& what) const {
    return {ErrorCode::usage, what + " no pixels, so a label picture cannot be used", options.labels.string(),
            Reason::labels_without_pixels};
  }
};

}  // namespace

Result<FittedInput> fit_shapes(const FitShapesOptions& options, const Work& work) {
  const auto input = sources::recognise_input(options.input.files, options.input.kind);
  if (!input) return input.error();
  auto read = read_input(*input, options.input, work);
  if (!read) return read.error();
  const auto seen = std::visit(SeenIn{options, work}, read->values);
  if (!seen) return at_place(seen.error(), input->files.back());
  auto fitted = recipes::shapes_from_points(*seen, options.shapes, work);
  if (!fitted) return at_place(fitted.error(), options.input.files.front());
  return FittedInput{*std::move(fitted), std::move(read->notes)};
}

}  // namespace palpable::session
