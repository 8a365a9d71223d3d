// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/make_scene.hpp"

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/session/make/fuse_frames.hpp"
#include "palpable/session/make/make_contours.hpp"
#include "palpable/session/make/make_field.hpp"
#include "palpable/session/make/places.hpp"
#include "palpable/session/make/regions.hpp"
#include "palpable/session/make/relief_scene.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"
#include "palpable/vision/stereo/result/front_view.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

StereoInput stereo_input(const MakeOptions& options) {
  return {options.inputs, options.calibration, options.layout, options.rectification, options.moved_m};
}

/// What is matched, as seen from between the cameras: picture, disparity and camera.
Result<void> look_from_the_front(vision::StereoPair& pair, DisparityMap& disparity, const Work& work) {
  auto front = vision::front_view(pair, disparity.disparity_px, work);
  if (!front) return front.error();
  pair.left = std::move(front->picture);
  disparity.disparity_px = std::move(front->disparity_px);
  // Half a baseline to the right everything lies half its disparity to the left; at infinity, half of doffs.
  if (disparity.rig) disparity.rig->left.cx += 0.5 * disparity.rig->doffs_px;
  return {};
}

Result<MadeScene> from_pair(const ReadyPair& ready, vision::StereoMethod method, const MakeOptions& options,
                            const Work& work) {
  auto match = vision::match(ready.pair, method, {options.max_disparity_px}, work);
  if (!match) return at_place(match.error(), names_of(options.inputs));
  std::vector<std::string> notes = ready.notes;
  notes.insert(notes.end(), match->notes.begin(), match->notes.end());
  if (method == vision::StereoMethod::fast)
    notes.push_back(vision::sentence_of(vision::fit_to_touch(ready.pair, *match, work)));
  vision::StereoPair pair = ready.pair;
  if (options.texture == Texture::front)
    if (const auto looked = look_from_the_front(pair, match->disparity, work); !looked)
      return at_place(looked.error(), names_of(options.inputs));
  models::Scene regions;
  const auto shaped =
      with_regions_treated(match->disparity, {rgb8(pair.left)}, options, work, regions, notes);
  auto relief = sculpt::relief_from_disparity(shaped, options.relief, work);
  if (!relief) return at_place(relief.error(), names_of(options.inputs));
  models::Scene scene = relief_scene(std::move(*relief), options, pair.left.width, pair.left.height,
                                     "stereo, " + std::string(vision::name_of(method)));
  scene.materials = std::move(regions.materials);
  scene.labels = std::move(regions.labels);
  if (options.texture != Texture::none) scene.texture = rgb8(pair.left);
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), std::move(notes)};
}

Result<models::Relief> relief_of(const std::variant<DepthMap, DisparityMap>& depth,
                                 const MakeOptions& options, const Work& work) {
  const auto* metres = std::get_if<DepthMap>(&depth);
  return metres != nullptr
             ? sculpt::relief_from_depth(*metres, options.relief, work)
             : sculpt::relief_from_disparity(std::get<DisparityMap>(depth), options.relief, work);
}

/// `files` as they were recognised: the depth alone, or its colour picture first.
Result<MadeScene> from_depth(const MakeOptions& options, const std::vector<std::filesystem::path>& files,
                             const Work& work) {
  sources::DepthSettings settings = options.depth;
  if (!options.calibration.empty()) {
    const auto calibration = sources::read_calibration(options.calibration);
    if (!calibration) return calibration.error();
    settings.camera = sources::pinhole_of(calibration->left);
  }
  auto read = sources::read_depth_picture(files, settings);
  if (!read) return read.error();
  models::Scene regions;
  treat_regions(*read, options, work, regions);
  auto relief = relief_of(read->depth, options, work);
  if (!relief) return at_place(relief.error(), files.back());
  const auto* metres = std::get_if<DepthMap>(&read->depth);
  const Raster<float>& values =
      metres != nullptr ? metres->depth_m : std::get<DisparityMap>(read->depth).disparity_px;
  const int width = values.width(), height = values.height();
  models::Scene scene = relief_scene(std::move(*relief), options, width, height, "depth map");
  if (!regions.labels.empty()) {
    scene.materials = std::move(regions.materials);
    scene.labels = std::move(regions.labels);
  }
  if (read->colour && options.texture != Texture::none) scene.texture = rgb8(*read->colour);
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), std::move(read->notes)};
}

Result<MadeScene> from_scene_file(const MakeOptions& options) {
  if (options.inputs.size() != 1) return Error{ErrorCode::usage, "a scene is one file", {}};
  auto file = formats::read_scene(options.inputs.front());
  if (!file) return file.error();
  return MadeScene{std::make_shared<const models::Scene>(std::move(file->scene)), {}};
}

/// A relief as it is, or the volume under it where a field or a grid is wanted (Park & Howard 2012).
Result<MadeScene> as_wanted(Result<MadeScene> made, const MakeOptions& options, const Work& work) {
  if (!made || (options.as != MakeAs::grid && options.as != MakeAs::field)) return made;
  models::Scene scene = *made->scene;
  const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&scene.model);
  if (relief == nullptr)
    return Error{ErrorCode::usage,
                 "fields and grids are filled under a relief, and this is a " + models::kind_of(scene.model),
                 names_of(options.inputs)};
  if (options.as == MakeAs::field) {
    auto field = field_from_relief(*made, **relief, options, work);
    if (!field) return at_place(field.error(), names_of(options.inputs));
    return field;
  }
  work.report(0.95, "filling the grid");
  const auto filled = sculpt::occupancy_from_relief(**relief, options.grid);
  if (!filled) return filled.error();
  auto occupancy = models::OccupancyGrid::from(*filled, work);
  if (!occupancy) return at_place(occupancy.error(), names_of(options.inputs));
  scene.model = std::make_shared<const models::Grid>(models::Grid{*std::move(occupancy), *relief});
  scene.source.method += ", filled into a grid";
  return MadeScene{std::make_shared<const models::Scene>(std::move(scene)), std::move(made->notes)};
}

bool is_solid(sources::InputKind kind) {
  return kind == sources::InputKind::mesh || kind == sources::InputKind::points ||
         kind == sources::InputKind::shapes || kind == sources::InputKind::level_set;
}

bool as_contours(const MakeOptions& options, const sources::Input& input) {
  return options.as == MakeAs::contours ||
         (options.as == MakeAs::by_input && input.kind == sources::InputKind::picture);
}

/// A pair that depth is matched from.
bool is_matched(const MakeOptions& options, const sources::Input& input) {
  return input.kind == sources::InputKind::stereo && !as_contours(options, input);
}

/// What tells ground and background apart: a pair, or one depth map.
bool has_regions(const MakeOptions& options, const sources::Input& input) {
  return is_matched(options, input) ||
         (input.kind == sources::InputKind::depth && !as_contours(options, input));
}

Error not_yet(const sources::Input& input) {
  return {ErrorCode::usage,
          "a " + std::string(sources::name_of(input.kind)) +
              " cannot be made into that: give a stereo pair, a depth map, a mesh, points with normals or a "
              "scene (or say --kind)",
          names_of(input.files)};
}

/// Several depth maps of one scene become a field.
Result<MadeScene> from_frames(const MakeOptions& options, const Work& work) {
  if (options.as != MakeAs::field && options.as != MakeAs::by_input)
    return Error{ErrorCode::usage, "several depth maps become a field and nothing else yet",
                 names_of(options.inputs)};
  return field_from_file(options, {sources::InputKind::depth, options.inputs, {}}, work);
}

bool is_available(vision::StereoMethod method) {
  const auto methods = vision::available_stereo_methods();
  return std::find(methods.begin(), methods.end(), method) != methods.end();
}

/// What a touch of a pair begins with, and what it goes on with.
std::vector<vision::StereoMethod> methods_of_a_touch(const MakeOptions& options) {
  if (options.method) return {*options.method};
  const vision::StereoMethod last = default_method();
  const vision::StereoMethod first =
      is_available(vision::StereoMethod::fast) ? vision::StereoMethod::fast : vision::StereoMethod::scanline;
  return first == last ? std::vector{last} : std::vector{first, last};
}

/// Ground and background are told apart by depth as one camera sees it: what cannot be done is said.
Result<MadeScene> without_regions(Result<MadeScene> made, const MakeOptions& options) {
  if (made && asks_for_regions(options))
    made->notes.emplace_back(
        "--ground and --background are for pairs and single depth maps: this is as without them.");
  return made;
}

Result<MadeScene> made_from(const sources::Input& input, const MakeOptions& options, const Work& work) {
  if (as_contours(options, input)) return contours_from_picture(options, work);
  const bool as_field = options.as == MakeAs::field || options.as == MakeAs::by_input;
  if (options.field_keeping != FieldKeeping::adaptive && options.as != MakeAs::field && !is_solid(input.kind))
    return Error{ErrorCode::usage, "--dense and --paper are ways to keep a field: say --as field",
                 names_of(input.files)};
  if (is_solid(input.kind)) return as_field ? field_from_file(options, input, work) : not_yet(input);
  switch (input.kind) {
    case sources::InputKind::scene:
      return as_wanted(from_scene_file(options), options, work);
    case sources::InputKind::depth: {
      auto made = from_depth(options, input.files, work);
      if (made) made->notes.insert(made->notes.begin(), input.notes.begin(), input.notes.end());
      return as_wanted(std::move(made), options, work);
    }
    case sources::InputKind::stereo: {
      const auto pair = read_stereo_pair(stereo_input(options), work);
      if (!pair) return pair.error();
      return as_wanted(from_pair(*pair, options.method.value_or(default_method()), options, work), options,
                       work);
    }
    default:
      return not_yet(input);
  }
}

}  // namespace

vision::StereoMethod default_method() {
  return is_available(vision::StereoMethod::best) ? vision::StereoMethod::best
                                                  : vision::StereoMethod::scanline;
}

Result<MadeScene> make_scene(const MakeOptions& options, const Work& work) {
  if (fuses_frames(options)) return without_regions(from_frames(options, work), options);
  const auto input = sources::recognise_input(options.inputs, options.kind);
  if (!input) return input.error();
  auto made = made_from(*input, options, work);
  return has_regions(options, *input) ? std::move(made) : without_regions(std::move(made), options);
}

Result<void> make_scenes(const MakeOptions& options, const TakeScene& take, const Work& work) {
  const auto alone = [&]() -> Result<void> {
    auto made = make_scene(options, work);
    if (!made) return made.error();
    take(std::move(*made));
    return {};
  };
  if (fuses_frames(options)) return alone();
  const auto input = sources::recognise_input(options.inputs, options.kind);
  if (!input) return input.error();
  if (!is_matched(options, *input)) return alone();
  const auto pair = read_stereo_pair(stereo_input(options), work);
  if (!pair) return pair.error();
  for (const vision::StereoMethod method : methods_of_a_touch(options)) {
    auto made = as_wanted(from_pair(*pair, method, options, work), options, work);
    if (!made) return made.error();
    take(std::move(*made));
  }
  return {};
}

}  // namespace palpable::session
