// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_recipe.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/recipes/solid/fused_depth_recipe.hpp"
#include "palpable/recipes/video/video_tracks.hpp"
#include "palpable/vision/image/luma.hpp"
#include "palpable/vision/motion/depth/rolled_pictures.hpp"
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"

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
  VideoFigures figures;
  // The one in which a length is known; -1 = none.
  int of_length = -1;
  // Those without rolling shutter, where there is one.
  std::vector<VideoFrame> corrected;
};

double brightness_of(const std::vector<Raster<std::uint8_t>>& greys) {
  double sum = 0.0, count = 0.0;
  for (const auto& grey : greys)
    for (std::size_t i = 0; i < grey.count(); i += 16) sum += grey.values()[i], ++count;
  return count > 0 ? sum / count / 255 : 0.0;
}

// Whether grey levels differ by more than noise.
bool shows_anything(const Raster<std::uint8_t>& grey, const VideoAdviceOptions& options) {
  std::vector<std::uint8_t> levels(grey.values().begin(), grey.values().end());
  const int low = quantile_of(levels, 0.01), high = quantile_of(levels, 0.99);
  return high - low >= options.least_contrast;
}

// Keeps the frame of a known length, even if it is blurred.
Result<void> keep_frame_of_length(const std::vector<VideoFrame>& given, const VideoRecipe& recipe,
                                  std::vector<int>& kept) {
  if (!recipe.length) return {};
  const int number = recipe.length->frame_number;
  const auto at = std::find_if(given.begin(), given.end(),
                               [&](const VideoFrame& frame) { return frame.number == number; });
  if (at == given.end() || (recipe.until && number > *recipe.until))
    return Error{ErrorCode::usage,
                 fmt::format("frame {} of the known length is not one of the frames that are used", number),
                 {}};
  const int index = static_cast<int>(at - given.begin());
  if (!std::binary_search(kept.begin(), kept.end(), index))
    kept.insert(std::upper_bound(kept.begin(), kept.end(), index), index);
  return {};
}

Result<Frames> frames_of(const std::vector<VideoFrame>& given, const VideoRecipe& recipe, const Work& work) {
  std::vector<Raster<std::uint8_t>> greys = greys_of(given);
  const auto used = std::count_if(given.begin(), given.end(), [&](const VideoFrame& frame) {
    return !recipe.until || frame.number <= *recipe.until;
  });
  greys.resize(static_cast<std::size_t>(used));
  auto usable = vision::usable_frames(greys, recipe.frames, work);
  if (!usable) return usable.error();
  if (auto kept = keep_frame_of_length(given, recipe, usable->kept); !kept) return kept.error();
  Frames out;
  out.figures.frames = static_cast<int>(used);
  out.figures.blurred = usable->blurred, out.figures.copies = usable->copies;
  out.figures.soft = usable->soft;
  out.figures.edge_width_px = usable->edge_width_px;
  out.figures.tried = static_cast<int>(usable->kept.size());
  out.figures.brightness = brightness_of(greys);
  for (const int i : usable->kept) {
    if (recipe.length && given[static_cast<std::size_t>(i)].number == recipe.length->frame_number)
      out.of_length = static_cast<int>(out.frames.size());
    out.frames.push_back(&given[static_cast<std::size_t>(i)]);
    out.greys.push_back(std::move(greys[static_cast<std::size_t>(i)]));
  }
  if (usable->blurred + usable->copies > 0)
    out.notes.emplace_back(
        fmt::format("{} of {} frames were left out: {} blurred, {} the same as the one before.",
                    usable->blurred + usable->copies, used, usable->blurred, usable->copies));
  return out;
}

VideoReconstruction reconstruction_of(const Frames& frames, const CameraMotion& motion,
                                      const std::vector<FrameDepth>& maps) {
  VideoReconstruction out;
  const auto frame_of = [&](int frame) { return frames.frames[static_cast<std::size_t>(frame)]; };
  for (std::size_t i = 0; i < motion.poses.size(); ++i)
    if (motion.poses[i]) out.poses.push_back({frame_of(static_cast<int>(i))->number, *motion.poses[i]});
  for (const FrameDepth& map : maps)
    out.depth_maps.push_back(
        {frame_of(map.frame)->number, map.filled, map.map.pose, frame_of(map.frame)->picture});
  out.camera = motion.camera;
  out.figures = frames.figures;
  out.figures.posed = static_cast<int>(out.poses.size());
  out.figures.reprojection_rms_px = motion.reprojection_rms_px;
  return out;
}

// What the maps show of the model, and the advice that follows from all figures.
void judge(const VideoModel& model, const VideoAdviceOptions& options, VideoReconstruction& video) {
  const auto axes_from_world = model.axes.axes_from_world();
  std::vector<Vec3> positions;
  for (const auto& pose : video.poses)
    positions.push_back((axes_from_world * Point<WorldFrame>{pose.world_from_camera.translation_m}).v);
  add_seen_sides(positions, 0.5 * (model.least + model.most), options, video.figures);
  std::size_t known = 0, all = 0;
  for (const auto& depth : video.depth_maps) {
    const auto values = depth.map.depth_m.values();
    known +=
        static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](float z) { return z > 0; }));
    all += values.size();
  }
  video.figures.known_depth = all > 0 ? static_cast<double>(known) / static_cast<double>(all) : 0.0;
  video.advice = advice_on(video.figures, options);
}

// A scene of known scale keeps its metres. Cells that are smaller than the fused voxels would only follow
// their noise, which takes most of the time.
FieldRecipe placed(const VideoRecipe& recipe, bool metric) {
  FieldRecipe field = recipe.field;
  if (recipe.surface != VideoSurface::superquadrics)
    field.field.resolution = std::min(field.field.resolution, recipe.fusion.resolution);
  sculpt::PlacementOptions& placement = field.placement;
  placement.convention = {AxisDirection::plus_z, metric ? LengthUnit::metre : LengthUnit::unknown};
  if (metric && !placement.size_m) {
    placement.default_size = sculpt::DefaultSize::own;
    return field;
  }
  placement.default_size = sculpt::DefaultSize::for_a_hand;
  placement.up = AxisDirection::plus_z;
  if (placement.lay == sculpt::Lay::automatic) placement.lay = sculpt::Lay::flat;
  return field;
}

Result<MadeScene> fused_field(const VideoModel& model, const std::vector<FrameDepth>& maps,
                              const VideoRecipe& recipe, const FieldRecipe& field, const Work& work) {
  std::vector<sculpt::DepthView> views;
  const auto axes_from_world = model.axes.axes_from_world();
  for (const FrameDepth& map : maps) views.push_back({&map.map.depth, axes_from_world * map.map.pose});
  // The model stands on the ground, below which nobody looks.
  sculpt::FusionOptions fusion = recipe.fusion;
  fusion.unseen = sculpt::Unseen::solid_below_surfaces;
  return field_from_views(views, {fusion, field, recipe.fused.least_part, recipe.fused.most_triangles},
                          "video", work);
}

// The median distance of the model's points from the field's surface, metres of the scene.
double distance_from(const models::Scene& scene, const VideoModel& model) {
  const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model);
  if (field == nullptr || model.raised.empty()) return 0.0;
  std::vector<double> distances;
  for (const Vec3& p : model.raised)
    distances.push_back(std::abs(
        (*field)->distance.sample(scene.scene_from_input * Point<models::InputFrame>{p}).distance_m));
  return quantile_of(distances, 0.5);
}

Result<MadeScene> field_of_shapes(const VideoModel& model, const VideoRecipe& recipe,
                                  const FieldRecipe& field, const Work& work) {
  work.report(0.0, "fitting superquadrics");
  auto shapes = shapes_of_model(model, recipe.shapes, work);
  if (!shapes) return shapes.error();
  const std::size_t count = shapes->shapes.size() - 1;
  auto made = field_from_superquadrics(std::move(shapes->shapes), field, work);
  if (!made) return made;
  const double before = distance_from(made->scene, model);
  made->notes.insert(
      made->notes.begin(),
      Note(fmt::format(
          "{} objects on the ground became {} superquadrics, {:.2f} mm from the measured points (median).",
          shapes->objects, count, 1000 * before)));
  return made;
}

// The field was made from values in the ground's axes; its scene states the world of the poses as its input.
void state_world(const VideoModel& model, models::Scene& scene) {
  const auto axes = model.axes.axes_from_world();
  Transform<models::InputFrame, models::InputFrame> axes_from_input;
  axes_from_input.rotation = axes.rotation, axes_from_input.translation_m = axes.translation_m;
  scene.scene_from_input = scene.scene_from_input * axes_from_input;
}

Result<MadeScene> corrected_field(const VideoModel& model, const std::vector<FrameDepth>& maps,
                                  const VideoRecipe& recipe, const FieldRecipe& field, const Work& work,
                                  VideoReconstruction& video) {
  std::vector<int> numbers;
  for (const auto& depth : video.depth_maps) numbers.push_back(depth.frame_number);
  const TakeState grown = [&](MadeScene state) {
    state_world(model, state.scene);
    recipe.grown(std::move(state));
  };
  const auto observer =
      growing_fields(recipe.growth, field, std::move(numbers), recipe.grown ? grown : TakeState(), work);
  auto corrected = corrected_model(model, maps, video.depth_maps.front().picture, recipe.shapes,
                                   recipe.corrected, observer, work);
  if (!corrected) return corrected.error();
  const bool kept = corrected->surface.triangles.empty();
  auto made = kept ? field_from_superquadrics(std::move(corrected->shapes.shapes), field, work)
                   : field_from_corrected_shapes(std::move(corrected->surface),
                                                 std::move(corrected->shapes.shapes), field, work);
  if (!made) return made;
  const double scale = made->scene.scene_from_input.scale;
  for (const ModelStep& step : corrected->steps)
    video.steps.push_back(
        {step.kind, video.depth_maps[step.map].frame_number, scale * step.error, step.taken});
  made->notes.insert(
      made->notes.begin(),
      Note(fmt::format("The superquadrics of {} objects are {:.2f} mm from the measured points (mean); {}.",
                       corrected->shapes.objects, 1000 * scale * corrected->predicted_error,
                       kept ? std::string("their correction was not closer, so they were kept")
                            : fmt::format("their correction by {} depth maps left {:.2f} mm", maps.size(),
                                          1000 * scale * corrected->corrected_error))));
  return made;
}

std::vector<const Raster<Rgb8>*> pictures_of(const Frames& frames) {
  std::vector<const Raster<Rgb8>*> out;
  for (const VideoFrame* frame : frames.frames) out.push_back(&frame->picture);
  return out;
}

struct ScaledDepth {
  std::vector<FrameDepth> maps;
  VideoScale scale;
};

// Computes depth, and scales it and the motion to metres where a marker or a length is known.
Result<ScaledDepth> scaled_depth(const Frames& frames, const VideoRecipe& recipe, CameraMotion& motion,
                                 const Work& work) {
  ScaledDepth out;
  if (!recipe.length) out.scale = scale_from_markers(frames.greys, motion, recipe.scale, work);
  if (work.cancelled()) return Work::interrupted();
  if (out.scale.metres_per_unit) vision::scale_motion(motion, *out.scale.metres_per_unit);
  vision::VideoDepthOptions depth = recipe.depth;
  depth.favoured_normal = ground_normal(motion, recipe.model.axes, work.seed);
  if (frames.of_length >= 0) depth.also.push_back(frames.of_length);
  auto maps = vision::depth_of_video(pictures_of(frames), motion, motion.camera, depth, work);
  if (!maps) return maps.error();
  out.maps = std::move(*maps);
  if (!recipe.length) return out;
  out.scale = scale_from_length(*recipe.length, frames.of_length, out.maps, recipe.scale);
  if (!out.scale.metres_per_unit) return out;
  vision::scale_motion(motion, *out.scale.metres_per_unit);
  vision::scale_depth(out.maps, *out.scale.metres_per_unit);
  return out;
}

std::vector<int> numbers_of(const Frames& frames) {
  std::vector<int> out;
  for (const VideoFrame* frame : frames.frames) out.push_back(frame->number);
  return out;
}

// Replaces the frames by pictures as if all rows had been read at once.
void remove_rolling_shutter(Frames& frames, const CameraMotion& motion, const Work& work) {
  if (motion.readout == vision::Readout{}) return;
  const std::vector<int> numbers = numbers_of(frames);
  frames.corrected.resize(frames.frames.size());
  parallel_for(work, static_cast<int>(frames.frames.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!motion.poses[i]) continue;
      frames.corrected[i] = {numbers[i],
                             vision::without_rolling_shutter(frames.frames[i]->picture, motion, k, numbers)};
      frames.greys[i] = vision::luma8(frames.corrected[i].picture);
    }
  });
  for (std::size_t i = 0; i < frames.frames.size(); ++i)
    if (motion.poses[i]) frames.frames[i] = &frames.corrected[i];
  frames.notes.emplace_back(fmt::format(
      "The camera reads each picture's {} one after the other, within {:.0f} % of the time between two "
      "pictures (rolling shutter): this was corrected.",
      std::abs(motion.readout.rows) >= std::abs(motion.readout.columns) ? "rows" : "columns",
      100 * std::max(std::abs(motion.readout.rows), std::abs(motion.readout.columns))));
}

Result<CameraMotion> motion_of(Frames& frames, const vision::VideoCamera& camera, const VideoRecipe& recipe,
                               const Work& work) {
  const auto found = tracks_of_video(frames.greys, recipe, work);
  if (!found) return found.error();
  const std::vector<vision::PointTrack>& tracks = found->tracks;
  if (!found->are_followed)
    frames.notes.emplace_back(
        "Points could not be followed, since pictures were taken far apart or are blurred: "
        "they were matched, which takes longer.");
  const int count = static_cast<int>(frames.greys.size());
  std::vector<int> shared = shared_points(tracks, count);
  frames.figures.followed_points = quantile_of(shared, 0.5);
  vision::BatchMotionOptions batch = recipe.motion;
  if (!found->are_followed) batch.rolling_shutter = 0;
  const std::vector<int> numbers = numbers_of(frames);
  auto motion = recipe.motion_method == VideoMotion::filter
                    ? vision::motion_by_filter(tracks, count, camera, recipe.filter, work)
                    : vision::motion_from_tracks(tracks, numbers, camera, batch, work);
  if (!motion) return motion;
  for (const int cut : cuts_in(tracks, motion->poses, recipe.advice))
    frames.figures.cuts.push_back(frames.frames[static_cast<std::size_t>(cut)]->number);
  const auto& size = frames.greys.front();
  const auto seen =
      vision::without_rolling_shutter(tracks, motion->readout, size.width(), size.height(), numbers);
  frames.figures.moving_points = vision::moving_points(seen, *motion, recipe.moving).share();
  remove_rolling_shutter(frames, *motion, work);
  return motion;
}

Result<MadeScene> field_of_surface(const VideoModel& model, const std::vector<FrameDepth>& maps,
                                   const VideoRecipe& recipe, const FieldRecipe& field, const Work& work,
                                   VideoReconstruction& video) {
  switch (recipe.surface) {
    case VideoSurface::superquadrics:
      return field_of_shapes(model, recipe, field, work);
    case VideoSurface::corrected:
      return corrected_field(model, maps, recipe, field, work, video);
    case VideoSurface::fused:
      break;
  }
  return fused_field(model, maps, recipe, field, work);
}

// All notes in the order in which a person needs them.
std::vector<Note> notes_of(const Frames& frames, const VideoReconstruction& video, const VideoScale& scale,
                           const std::vector<Note>& of_field) {
  std::vector<Note> out;
  out.emplace_back(fmt::format(
      "The camera's path was found in {} of {} frames; the reprojection error is {:.2f} px (root mean "
      "square).",
      video.figures.posed, video.figures.tried, video.figures.reprojection_rms_px));
  for (const auto* notes : {&frames.notes, &video.advice, &scale.notes, &of_field})
    out.insert(out.end(), notes->begin(), notes->end());
  if (!scale.metres_per_unit)
    out.emplace_back(
        "No length is known, so the true size is not: show the printed marker in the video, or state a "
        "length.");
  return out;
}

}  // namespace

Result<MadeScene> field_from_video(const std::vector<VideoFrame>& given, const vision::VideoCamera& camera,
                                   const VideoRecipe& recipe, const Work& work) {
  auto frames = frames_of(given, recipe, work);
  if (!frames) return frames.error();
  if (frames->figures.frames < 2)
    return invalid_input(
        "a single picture shows no depth: film the model, or take several pictures, while you walk around "
        "it");
  if (frames->figures.tried < 2 && !shows_anything(frames->greys.front(), recipe.advice))
    return invalid_input(
        "the pictures show nothing but one plain colour: film the model on a printed cloth or a newspaper, "
        "in even light");
  if (frames->figures.tried < 2)
    return invalid_input("the camera did not move: record it again, moving slowly around the model");
  auto motion = motion_of(*frames, camera, recipe, work);
  if (!motion) return motion.error();
  auto depth = scaled_depth(*frames, recipe, *motion, work);
  if (!depth) return depth.error();
  frames->figures.covered =
      std::ranges::max(vision::covered_shares(depth->maps, pictures_of(*frames), recipe.covered));
  VideoModel model = video_model(depth->maps, recipe.model, work.seed);
  if (model.structure.places_m.empty())
    return invalid_input(
        "no surface looks the same from several directions: record it again, more slowly and in more light");
  VideoReconstruction video = reconstruction_of(*frames, *motion, depth->maps);
  video.metric = depth->scale.metres_per_unit.has_value();
  video.reduction = recipe.reduction;
  judge(model, recipe.advice, video);
  flatten_ground(depth->maps, model, recipe.model);
  crop(depth->maps, model);
  const FieldRecipe field = placed(recipe, video.metric);
  auto made = field_of_surface(model, depth->maps, recipe, field, work, video);
  if (!made) return made.error();
  state_world(model, made->scene);
  const auto& placed_by = made->scene.scene_from_input;
  video.scene_from_world = {placed_by.rotation, placed_by.translation_m, placed_by.scale};
  made->notes = notes_of(*frames, video, depth->scale, made->notes);
  video.structure = std::move(model.structure);
  made->video = std::make_shared<const VideoReconstruction>(std::move(video));
  return made;
}

}  // namespace palpable::recipes
