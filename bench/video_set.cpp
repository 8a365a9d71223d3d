// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/measure/camera_path_score.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/vision/image/luma.hpp"
#include "palpable/vision/motion/depth/covered_frames.hpp"
#include "palpable/vision/motion/depth/marker_scale.hpp"
#include "palpable/vision/motion/depth/rolled_pictures.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"
#include "palpable/vision/motion/structure/moving_points.hpp"
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"
#include "palpable/vision/motion/tracks/usable_frames.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rendered_video.hpp"
#include "video_depth_figures.hpp"
#include "video_faults.hpp"
#include "video_set_arguments.hpp"
#include "video_surfaces.hpp"
#include <fmt/format.h>
#include <sys/resource.h>

// Structure, motion and depth of rendered videos (rendered_video.hpp) with their exact truth; its words:
// video_set_arguments.hpp.
namespace palpable::bench {
namespace {

using vision::CameraMotion;
using vision::FrameDepth;

// Processor time of each stage, s.
struct StageSeconds {
  double tracks = 0, motion = 0, depth = 0, surfaces = 0;
};

struct Figures {
  int posed = 0;
  double position_percent = 0, rotation_deg = 0, reprojection_px = 0;
  /// By which the found points are too far, median, % of their depth.
  double too_far_percent = 0;
  DepthFigures depth;
  StageSeconds seconds;
  /// Share of the points that move by themselves, %, of which there are none; width of the sharpest edges,
  /// px.
  double moving_percent = 0, edge_width_px = 0;
  /// The largest area that something covers in one frame, % of the picture.
  double covered_percent = 0;
  /// Error of the scale that a marker gives, %; NaN without a marker.
  double scale_error_percent = std::numeric_limits<double>::quiet_NaN();
  std::vector<NamedSurface> surfaces;
};

// Of the points in every tenth frame, where the path's scale is the true one.
double too_far_percent(std::span<const vision::PointTrack> tracks, const CameraMotion& motion,
                       const RenderedVideo& video, double scale, const Work& work) {
  constexpr int kStep = 10;
  std::vector<double> errors;
  for (int frame = 0; frame < video.frames(); frame += kStep) {
    const auto& pose = motion.poses[static_cast<std::size_t>(frame)];
    if (!pose) continue;
    const Raster<float> truth = video.depth(frame, work);
    for (const vision::StructurePoint& point : motion.points) {
      if (!tracks[point.track].in_frame(frame)) continue;
      const auto place = tracks[point.track].in(frame);
      const auto z = static_cast<double>(
          truth(static_cast<int>(std::lround(place.x)), static_cast<int>(std::lround(place.y))));
      if (z > 0) errors.push_back(100 * (scale * (pose->inverse() * point.position).v.z / z - 1));
    }
  }
  return errors.empty() ? 0.0 : quantile_of(errors, 0.5);
}

struct PathErrors {
  Figures figures;
  measure::CameraPathScore score;
};

Result<PathErrors> path_errors(const CameraMotion& motion, const RenderedVideo& video) {
  std::vector<measure::FoundPose> found;
  std::vector<measure::TruePose> truth;
  for (int i = 0; i < video.frames(); ++i) {
    if (const auto& pose = motion.poses[static_cast<std::size_t>(i)]) found.push_back({i, *pose});
    const auto pose = video.pose(i);
    truth.push_back({i, {pose.rotation, pose.translation_m, pose.scale}});
  }
  const auto score = measure::score_camera_path(found, truth);
  if (!score) return score.error();
  PathErrors out;
  out.figures.posed = score->frames;
  out.figures.position_percent = score->position_rms_percent;
  out.figures.rotation_deg = score->mean_rotation_deg;
  out.figures.reprojection_px = motion.reprojection_rms_px;
  out.score = *score;
  return out;
}

// In megabytes, since the program began.
double peak_memory_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// The processor time since it was last asked, s.
class Stopwatch {
 public:
  double next() {
    const std::clock_t before = std::exchange(last_, std::clock());
    return static_cast<double>(last_ - before) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t last_ = std::clock();
};

// Surfaces from the true poses and depth maps with noise of 0.2 %: the correction alone, in seconds.
Result<Figures> run_on_true_depth(const RenderedVideo& video, VideoSetArguments& arguments,
                                  const Work& work) {
  Stopwatch watch;
  std::vector<FrameDepth> maps;
  std::vector<Raster<Rgb8>> pictures(static_cast<std::size_t>(video.frames()));
  const int count = arguments.recipe.depth.maps;
  Random random(7);
  for (int k = 0; k < count; ++k) {
    const int frame = k * (video.frames() - 1) / (count - 1);
    const auto pose = video.pose(frame);
    FrameDepth map{frame,
                   {{video.depth(frame, work), video.camera()}, {pose.rotation, pose.translation_m, 1}}};
    constexpr double kNoise = 0.002;
    for (float& z : map.map.depth.depth_m.values()) {
      const double noisy = static_cast<double>(z) * (1 + kNoise * random.normal());
      z = z > 0 ? static_cast<float>(noisy) : kUnknownDepth;
    }
    maps.push_back(std::move(map));
  }
  pictures[static_cast<std::size_t>(maps.front().frame)] = video.picture(maps.front().frame, work);
  auto surfaces =
      surfaces_of(video, std::move(maps), pictures, {}, arguments.surfaces, arguments.recipe, work);
  if (!surfaces) return surfaces.error();
  Figures out;
  out.surfaces = std::move(*surfaces);
  out.seconds.surfaces = watch.next();
  return out;
}

void write_errors(const std::vector<FrameDepth>& maps, const std::vector<Raster<Rgb8>>& pictures,
                  const RenderedVideo& video, const measure::CameraPathScore& path, const std::string& folder,
                  const Work& work) {
  const std::filesystem::path own = std::filesystem::path(folder) / fmt::format("seed_{:02}", video.seed());
  std::filesystem::create_directories(own);
  for (const FrameDepth& map : maps) {
    const auto& picture = pictures[static_cast<std::size_t>(map.frame)];
    const auto errors = depth_errors_of(map, picture, video, path, work);
    if (!formats::write_png(own / fmt::format("{:04}.png", map.frame), errors)) return;
  }
}

// From what --write wrote, else rendered.
Raster<Rgb8> picture_of(const RenderedVideo& video, int frame, const std::string& written, const Work& work) {
  const auto file = std::filesystem::path(written) / fmt::format("seed_{:02}", video.seed()) /
                    fmt::format("{:04}.png", frame);
  if (!written.empty())
    if (const auto bytes = read_file(file))
      if (const auto picture = formats::decode_png(*bytes)) return rgb8(*picture);
  return video.picture(frame, work);
}

std::vector<int> numbers_of(const RenderedVideo& video) {
  std::vector<int> out(static_cast<std::size_t>(video.frames()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

Result<CameraMotion> motion_of(const std::vector<vision::PointTrack>& tracks, const RenderedVideo& video,
                               const recipes::VideoRecipe& recipe, const Work& work) {
  const vision::VideoCamera camera{video.camera(), true};
  return recipe.motion_method == recipes::VideoMotion::filter
             ? vision::motion_by_filter(tracks, video.frames(), camera, recipe.filter, work)
             : vision::motion_from_tracks(tracks, numbers_of(video), camera, recipe.motion, work);
}

Result<Figures> run(const RenderedVideo& video, VideoSetArguments& arguments, const Work& work) {
  std::vector<Raster<Rgb8>> pictures;
  std::vector<Raster<std::uint8_t>> greys;
  for (int i = 0; i < video.frames(); ++i) {
    pictures.push_back(picture_of(video, i, arguments.written, work));
    draw_hand({video.seed(), arguments.hand_percent / 100.0, arguments.hand_contrast}, i, pictures.back());
    pictures.back() = defocused(pictures.back(), arguments.defocus_px);
    greys.push_back(vision::luma8(pictures.back()));
  }
  Stopwatch watch;
  const auto usable = vision::usable_frames(greys, arguments.recipe.frames, work);
  if (!usable) return usable.error();
  auto tracks = vision::track_points(greys, arguments.recipe.tracks, work);
  if (!tracks) return tracks.error();
  StageSeconds seconds;
  seconds.tracks = watch.next();
  const auto motion = motion_of(*tracks, video, arguments.recipe, work);
  if (!motion) return motion.error();
  seconds.motion = watch.next();
  *tracks = vision::without_rolling_shutter(*tracks, motion->readout, video.camera().width,
                                            video.camera().height, numbers_of(video));
  const auto path = path_errors(*motion, video);
  if (!path) return path.error();
  Figures out = path->figures;
  out.seconds = seconds;
  out.too_far_percent = too_far_percent(*tracks, *motion, video, path->score.true_from_found.scale, work);
  out.moving_percent = 100 * vision::moving_points(*tracks, *motion, arguments.recipe.moving).share();
  out.edge_width_px = usable->edge_width_px;
  if (arguments.marker_mm > 0)
    if (const auto scale = vision::scale_from_markers(greys, *motion, {}, work))
      out.scale_error_percent = 100 * (scale->metres_per_unit / path->score.true_from_found.scale - 1);
  if (arguments.depth) {
    for (int i = 0; i < video.frames(); ++i) {
      auto& picture = pictures[static_cast<std::size_t>(i)];
      if (motion->poses[static_cast<std::size_t>(i)])
        picture = vision::without_rolling_shutter(picture, *motion, i, numbers_of(video));
    }
    std::vector<const Raster<Rgb8>*> views;
    for (const auto& picture : pictures) views.push_back(&picture);
    watch.next();
    vision::VideoDepthOptions options = arguments.recipe.depth;
    options.favoured_normal = recipes::ground_normal(*motion, arguments.recipe.model.axes, work.seed);
    const auto maps = vision::depth_of_video(views, *motion, motion->camera, options, work);
    if (!maps) return maps.error();
    out.seconds.depth = watch.next();
    out.covered_percent =
        100 * std::ranges::max(vision::covered_shares(*maps, views, arguments.recipe.covered));
    out.depth = depth_figures(*maps, pictures, video, path->score, work);
    if (!arguments.errors.empty()) write_errors(*maps, pictures, video, path->score, arguments.errors, work);
    if (arguments.surfaces != Surfaces::none) {
      watch.next();
      auto surfaces =
          surfaces_of(video, *maps, pictures, path->score, arguments.surfaces, arguments.recipe, work);
      if (!surfaces) return surfaces.error();
      out.seconds.surfaces = watch.next();
      out.surfaces = std::move(*surfaces);
    }
  }
  return out;
}

void write_video(const RenderedVideo& video, const std::string& folder, int seed, const Work& work) {
  const std::filesystem::path own = std::filesystem::path(folder) / fmt::format("seed_{:02}", seed);
  std::filesystem::create_directories(own);
  std::string poses = "frame,qw,qx,qy,qz,tx,ty,tz\n";
  for (int i = 0; i < video.frames(); ++i) {
    if (!formats::write_png(own / fmt::format("{:04}.png", i), video.picture(i, work))) return;
    const auto pose = video.pose(i);
    const auto q = models::quaternion_of(pose.rotation);
    const Vec3 t = pose.translation_m;
    poses += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", i, q[0], q[1], q[2], q[3],
                         t.x, t.y, t.z);
  }
  const Pinhole& c = video.camera();
  std::ofstream(own.string() + "_poses.csv") << poses;
  std::ofstream(own.string() + "_intrinsics.json")
      << fmt::format(R"({{"fx": {}, "fy": {}, "cx": {}, "cy": {}, "width": {}, "height": {}}})", c.fx, c.fy,
                     c.cx, c.cy, c.width, c.height);
}

void print_row(const std::string& name, const Figures& f, int frames, bool steps) {
  fmt::print(
      "| {} | {} of {} | {:.3f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | "
      "{:.2f} | "
      "{:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f} |\n",
      name, f.posed, frames, f.position_percent, f.rotation_deg, f.too_far_percent, f.reprojection_px,
      f.depth.structure, f.depth.known, f.depth.good_of_known, f.depth.good_of_all, f.depth.good_of_textured,
      f.scale_error_percent, f.moving_percent, f.covered_percent, f.edge_width_px, f.seconds.tracks,
      f.seconds.motion, f.seconds.depth, f.seconds.surfaces, peak_memory_MB());
  for (std::size_t i = 0; i < f.surfaces.size(); ++i) {
    const NamedSurface& s = f.surfaces[i];
    const bool last_of_kind =
        i == 0 || i + 1 == f.surfaces.size() || s.name.substr(0, 4) != f.surfaces[i + 1].name.substr(0, 4);
    if (steps || last_of_kind)
      fmt::print(
          "    {}: median {:.2f} mm ({:.2f} % of the diagonal), mean {:.2f} mm, {:.1f} % within 1 %, {:.1f} "
          "% in "
          "air, {:.1f} s\n",
          s.name, s.figures.median_mm, 100 * s.figures.median_mm / s.figures.diagonal_mm, s.figures.mean_mm,
          s.figures.within_percent, s.figures.in_air_percent, s.seconds);
  }
  std::fflush(stdout);
}

int run_all(VideoSetArguments& arguments) {
  Work work;
  work.threads = arguments.threads;
  fmt::print(
      "| video | frames | position, % of path | rotation, deg | points too far, % | reprojection, px | "
      "structure, % of diagonal "
      "| depth known, % | within 1 %, % of known | of all | of those with texture | scale error, % "
      "| moving points, % | covered, % | edges, px | processor s: points | path | depth | surfaces | most "
      "memory, MB |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<double> position, rotation, good;
  for (int seed = arguments.first; seed < arguments.first + arguments.seeds; ++seed) {
    RenderedVideo video(static_cast<std::uint32_t>(seed), arguments.frames);
    if (arguments.marker_mm > 0) video.add_marker(arguments.marker_mm);
    if (!arguments.folder.empty()) {
      write_video(video, arguments.folder, seed, work);
      continue;
    }
    const auto figures =
        arguments.true_depth ? run_on_true_depth(video, arguments, work) : run(video, arguments, work);
    if (!figures) {
      fmt::print("| {} | {} |\n", video.description(), figures.error().message);
      continue;
    }
    print_row(video.description(), *figures, video.frames(), arguments.steps);
    position.push_back(figures->position_percent), rotation.push_back(figures->rotation_deg);
    good.push_back(figures->depth.good_of_textured);
  }
  if (!position.empty())
    fmt::print(
        "median position {:.3f} %, rotation {:.3f} deg, depth within 1 % {:.1f} % of pixels with texture; "
        "worst {:.3f} %, "
        "{:.3f} deg, "
        "{:.1f} %\n",
        quantile_of(position, 0.5), quantile_of(rotation, 0.5), quantile_of(good, 0.5),
        quantile_of(position, 1.0), quantile_of(rotation, 1.0), quantile_of(good, 0.0));
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) {
  palpable::bench::VideoSetArguments arguments;
  if (!palpable::bench::read(count, words, arguments)) {
    fmt::print(stderr, "{}", palpable::bench::kVideoSetUsage);
    return 2;
  }
  return palpable::bench::run_all(arguments);
}
