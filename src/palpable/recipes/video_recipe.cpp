// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video_recipe.hpp"

#include "palpable/core/quantile.hpp"
#include "palpable/recipes/fused_depth_recipe.hpp"
#include "palpable/vision/image/luma.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

using vision::CameraMotion;
using vision::FrameDepth;

std::vector<Raster<std::uint8_t>> greys_of(const std::vector<VideoFrame>& frames) {
  std::vector<Raster<std::uint8_t>> out;
  for (const VideoFrame& frame : frames) out.push_back(vision::luma8(frame.picture));
  return out;
}

// The frames that serve, and their grey levels.
struct Frames {
  std::vector<const VideoFrame*> frames;
  std::vector<Raster<std::uint8_t>> greys;
  std::vector<Note> notes;
};

Result<Frames> frames_of(const std::vector<VideoFrame>& given, const VideoRecipe& recipe, const Work& work) {
  std::vector<Raster<std::uint8_t>> greys = greys_of(given);
  const auto used = std::count_if(given.begin(), given.end(), [&](const VideoFrame& frame) {
    return !recipe.until || frame.number <= *recipe.until;
  });
  greys.resize(static_cast<std::size_t>(used));
  const auto chosen = vision::choose_frames(greys, recipe.frames, work);
  if (!chosen) return chosen.error();
  Frames out;
  for (const int i : chosen->kept) {
    out.frames.push_back(&given[static_cast<std::size_t>(i)]);
    out.greys.push_back(std::move(greys[static_cast<std::size_t>(i)]));
  }
  if (chosen->blurred + chosen->copies > 0)
    out.notes.emplace_back(
        fmt::format("{} of {} frames were left out: {} blurred, {} the same as the one before.",
                    chosen->blurred + chosen->copies, used, chosen->blurred, chosen->copies));
  return out;
}

// Whether most frames share enough points with the next one.
bool are_followed(const std::vector<vision::PointTrack>& tracks, int frames, int least_points) {
  std::vector<int> common(static_cast<std::size_t>(frames), 0);
  for (const vision::PointTrack& track : tracks)
    for (int i = track.first_frame; i + 1 < track.end_frame(); ++i) ++common[static_cast<std::size_t>(i)];
  const auto good = std::count_if(common.begin(), common.end(), [&](int c) { return c >= least_points; });
  constexpr double kMost = 0.8;
  return static_cast<double>(good) >= kMost * (frames - 1);
}

Result<std::vector<vision::PointTrack>> tracks_of(Frames& frames, const VideoRecipe& recipe,
                                                  const Work& work) {
  auto tracks = vision::track_points(frames.greys, recipe.tracks, work);
  constexpr int kTimesLeast = 3;
  if (!tracks ||
      are_followed(*tracks, static_cast<int>(frames.greys.size()), kTimesLeast * recipe.motion.least_points))
    return tracks;
  frames.notes.emplace_back(
      "The pictures were taken far apart: their points were matched, which takes longer than following "
      "them.");
  return vision::match_photos(frames.greys, recipe.photos, work);
}

VideoReconstruction reconstruction_of(const Frames& frames, const CameraMotion& motion,
                                      const std::vector<FrameDepth>& maps, PointCloud structure) {
  VideoReconstruction out;
  const auto number = [&](int frame) { return frames.frames[static_cast<std::size_t>(frame)]->number; };
  for (std::size_t i = 0; i < motion.poses.size(); ++i)
    if (motion.poses[i]) out.poses.push_back({number(static_cast<int>(i)), *motion.poses[i]});
  for (const FrameDepth& map : maps) out.depth_maps.push_back({number(map.frame), map.map.depth});
  out.structure = std::move(structure);
  out.reprojection_rms_px = motion.reprojection_rms_px;
  return out;
}

FieldRecipe placed_for_a_hand(const VideoRecipe& recipe) {
  FieldRecipe field = recipe.field;
  field.placement.default_size = sculpt::DefaultSize::for_a_hand;
  field.placement.convention = {AxisDirection::plus_z, LengthUnit::unknown};
  if (field.placement.lay == sculpt::Lay::automatic) field.placement.lay = sculpt::Lay::flat;
  return field;
}

Result<MadeScene> fused_field(const FilmedModel& model, const std::vector<FrameDepth>& maps,
                              const VideoRecipe& recipe, const Work& work) {
  std::vector<sculpt::DepthView> views;
  for (const FrameDepth& map : maps) views.push_back({&map.map.depth, model.axes.scene_from(map.map.pose)});
  return field_from_views(views, {recipe.fusion, placed_for_a_hand(recipe)}, "video", work);
}

// The median distance of the model's points from the field's surface, metres of the scene.
double distance_from(const models::Scene& scene, const FilmedModel& model) {
  const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model);
  if (field == nullptr || model.raised.empty()) return 0.0;
  std::vector<double> distances;
  for (const Vec3& p : model.raised)
    distances.push_back(std::abs(
        (*field)->distance.sample((scene.scene_from_input * Point<models::InputFrame>{p}).v).distance_m));
  return quantile_of(distances, 0.5);
}

Result<MadeScene> field_of_shapes(const FilmedModel& model, const VideoRecipe& recipe, const Work& work) {
  work.report(0.0, "fitting superquadrics");
  auto shapes = shapes_of_model(model, recipe.shapes, work);
  if (!shapes) return shapes.error();
  const std::size_t count = shapes->shapes.size() - 1;
  auto made = field_from_superquadrics(std::move(shapes->shapes), placed_for_a_hand(recipe), work);
  if (!made) return made;
  const double before = distance_from(made->scene, model);
  made->notes.insert(
      made->notes.begin(),
      Note(fmt::format(
          "{} objects on the table became {} superquadrics, {:.2f} mm from the measured points (median).",
          shapes->objects, count, 1000 * before)));
  return made;
}

}  // namespace

std::vector<Parameter> parameters_of(VideoRecipe& recipe) {
  std::vector<Parameter> out;
  append_parameters(out, "frames", vision::parameters_of(recipe.frames));
  append_parameters(out, "tracks", vision::parameters_of(recipe.tracks));
  append_parameters(out, "photos", vision::parameters_of(recipe.photos));
  append_parameters(out, "motion", vision::parameters_of(recipe.motion));
  append_parameters(out, "filter", vision::parameters_of(recipe.filter));
  append_parameters(out, "depth", vision::parameters_of(recipe.depth));
  append_parameters(out, "model", parameters_of(recipe.model));
  append_parameters(out, "shapes", parameters_of(recipe.shapes));
  return out;
}

Result<MadeScene> field_from_video(const std::vector<VideoFrame>& given, const vision::VideoCamera& camera,
                                   const VideoRecipe& recipe, const Work& work) {
  auto frames = frames_of(given, recipe, work);
  if (!frames) return frames.error();
  const auto tracks = tracks_of(*frames, recipe, work);
  if (!tracks) return tracks.error();
  const int frame_count = static_cast<int>(frames->greys.size());
  const auto motion = recipe.motion_method == VideoMotion::filter
                          ? vision::motion_by_filter(*tracks, frame_count, camera, recipe.filter, work)
                          : vision::motion_from_tracks(*tracks, frame_count, camera, recipe.motion, work);
  if (!motion) return motion.error();
  std::vector<const Raster<Rgb8>*> pictures;
  for (const VideoFrame* frame : frames->frames) pictures.push_back(&frame->picture);
  auto maps = vision::depth_of_video(pictures, *motion, motion->camera, recipe.depth, work);
  if (!maps) return maps.error();
  const FilmedModel model = filmed_model(*maps, recipe.model, work.seed);
  if (model.structure.places_m.empty())
    return Error{
        ErrorCode::invalid_input,
        "no surface looks the same from several directions: record it again, more slowly and in more light",
        {},
        Reason::unspecified};
  VideoReconstruction reconstruction = reconstruction_of(*frames, *motion, *maps, model.structure);
  crop(*maps, model);
  auto made = recipe.surface == VideoSurface::fused ? fused_field(model, *maps, recipe, work)
                                                    : field_of_shapes(model, recipe, work);
  if (!made) return made.error();
  made->notes.insert(made->notes.begin(), frames->notes.begin(), frames->notes.end());
  made->notes.insert(
      made->notes.begin(),
      Note(fmt::format(
          "The camera's path was found in {} of {} frames; the reprojection error is {:.2f} px (root mean "
          "square).",
          reconstruction.poses.size(), frames->frames.size(), motion->reprojection_rms_px)));
  made->video = std::make_shared<const VideoReconstruction>(std::move(reconstruction));
  return made;
}

}  // namespace palpable::recipes
