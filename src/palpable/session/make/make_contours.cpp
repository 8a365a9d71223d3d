// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/make_contours.hpp"

#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/sculpt/contours/junctions.hpp"
#include "palpable/session/make/places.hpp"
#include "palpable/session/make/relief_scene.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/vision/image/reduced_picture.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

constexpr std::size_t kMostPixels = std::size_t{4} << 20U;

std::string contour_source(vision::ContourMethod method) {
  switch (method) {
    case vision::ContourMethod::paper:
      return "contours, paper";
    case vision::ContourMethod::best:
      return "contours, best";
    case vision::ContourMethod::standard:
      break;
  }
  return "contours";
}

/// Junctions of grooves feel rough and have a name, so that fingers and ears find them.
void mark_junctions(models::Scene& scene, const models::BoundaryMap& map, const MakeOptions& options) {
  constexpr double kRadius_m = 0.0015;
  const auto in_px = [&map](double metres) { return metres / map.pixel_m(); };
  sculpt::JunctionOptions branches;
  branches.radius_px = std::clamp(static_cast<int>(std::lround(in_px(kRadius_m))), 5, 24);
  const auto line = sculpt::boundary_lines(map);
  const auto junctions = sculpt::find_junctions(line, branches);
  if (junctions.empty()) return;
  constexpr std::uint8_t kJunction = 1;
  scene.labels = sculpt::mark_junctions(junctions, line.width(), line.height(),
                                        in_px(0.75 * options.grooves.width_m), kJunction);
  scene.materials.resize(2);
  scene.materials[kJunction].name = "junction";
  scene.materials[kJunction].texture = {models::TouchTexture::Kind::bumps, 0.0015, 25e-6, 0.0};
}

}  // namespace

Result<MadeScene> contours_from_picture(const MakeOptions& options, const Work& work) {
  if (options.inputs.size() != 1) return Error{ErrorCode::usage, "contours are made of one picture", {}};
  const auto& file = options.inputs.front();
  auto picture = sources::read_picture(file);
  if (!picture) return picture.error();
  std::vector<std::string> notes;
  if (auto smaller = vision::reduced(*picture, kMostPixels)) {
    notes.push_back(
        fmt::format("The picture was reduced from {} x {} to {} x {} pixels, which a finger cannot tell.",
                    picture->width, picture->height, smaller->width, smaller->height));
    *picture = *std::move(smaller);
  }
  auto found = vision::find_contours(*picture, options.contours, work);
  if (!found) return at_place(found.error(), file);
  sculpt::BoundaryMapOptions size;
  size.radius_px = options.neighbourhood_px;
  if (options.relief.size_m)
    size.width_m = options.relief.size_m->x, size.height_m = options.relief.size_m->y;
  auto map = sculpt::boundary_map_from_contours(*found, size, work);
  if (!map) return at_place(map.error(), file);
  auto grooves = sculpt::grooves_from_boundary_map(*map, options.grooves);
  if (!grooves) return at_place(grooves.error(), file);
  models::Scene scene = relief_scene(std::move(*grooves), options, picture->width, picture->height,
                                     contour_source(options.contours.method));
  scene.model = std::make_shared<const models::Contours>(
      models::Contours{std::move(*map), std::get<std::shared_ptr<const models::Relief>>(scene.model)});
  mark_junctions(scene, std::get<std::shared_ptr<const models::Contours>>(scene.model)->boundaries, options);
  scene.texture = rgb8(*picture);
  notes.insert(notes.end(), found->notes.begin(), found->notes.end());
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), std::move(notes)};
}

}  // namespace palpable::session
