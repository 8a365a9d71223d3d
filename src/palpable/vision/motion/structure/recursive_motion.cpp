// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/recursive_motion.hpp"

#include "palpable/vision/motion/structure/first_pair.hpp"
#include "palpable/vision/motion/structure/motion_filter.hpp"
#include "palpable/vision/motion/structure/motion_result.hpp"
#include "palpable/vision/motion/structure/triangulation.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

namespace palpable::vision {
namespace {

enum class Direction { forward = 1, backward = -1 };

// What the filter found out about a track's point when it left the state.
struct PointEstimate {
  Vec3 world;
  double relative_spread = 0.0;
};

class FilterRun {
 public:
  FilterRun(std::span<const PointTrack> tracks, int frame_count, const VideoCamera& camera,
            const FilterMotionOptions& options)
      : tracks_(tracks),
        options_(options),
        filter_(camera, options),
        poses_(static_cast<std::size_t>(frame_count)),
        estimates_(tracks.size()),
        wrong_(tracks.size(), false) {}

  bool begin(int first, int second, const BundlePose& second_pose);
  Result<void> pass(int from, Direction direction, const Work& work);
  /// From the first or last frame that has a pose, which is the state's, to the other end.
  Result<void> turn_round(Direction direction, const Work& work);
  bool has_poses() const;
  FoundMotion result() const;

 private:
  void enter(std::size_t track, const TrackPlace& seen, double inverse_depth, double relative_spread) {
    filter_.add_point(seen, inverse_depth, relative_spread);
    active_.insert(track);
  }
  std::vector<TrackPlace> places_in(int frame) const;
  void remove_lost(int frame);
  void keep_estimates();
  void add_new(int frame, Direction direction);
  int remaining(std::size_t track, int frame, Direction direction) const;
  std::optional<std::array<double, 3>> structure_point(std::size_t track, const Pinhole& camera) const;

  std::span<const PointTrack> tracks_;
  FilterMotionOptions options_;
  MotionFilter filter_;
  std::set<std::size_t> active_;
  std::vector<std::optional<BundlePose>> poses_;
  std::vector<std::optional<PointEstimate>> estimates_;
  std::vector<bool> wrong_;
};

// The points that both frames determine, their mean inverse depth one; the longest tracks if there are many.
bool FilterRun::begin(int first, int second, const BundlePose& second_pose) {
  struct Start {
    std::size_t track;
    double depth;
  };
  std::vector<Start> starts;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].in_frame(first) || !tracks_[i].in_frame(second)) continue;
    const PosedObservation both[] = {{BundlePose{}, tracks_[i].in(first)},
                                     {second_pose, tracks_[i].in(second)}};
    const auto point =
        triangulated_point(both, filter_.camera(), {options_.least_angle_deg, options_.outlier_px});
    if (point) starts.push_back({i, (*point)[2]});
  }
  std::stable_sort(starts.begin(), starts.end(), [&](const Start& a, const Start& b) {
    return tracks_[a.track].end_frame() > tracks_[b.track].end_frame();
  });
  if (starts.size() > static_cast<std::size_t>(options_.most_points))
    starts.resize(static_cast<std::size_t>(options_.most_points));
  if (starts.size() < static_cast<std::size_t>(options_.least_points)) return false;
  const double mean = std::accumulate(starts.begin(), starts.end(), 0.0,
                                      [](double sum, const Start& s) { return sum + 1 / s.depth; }) /
                      static_cast<double>(starts.size());
  for (const Start& start : starts)
    enter(start.track, {start.track, tracks_[start.track].in(first)}, 1 / (start.depth * mean),
          options_.depth_spread);
  filter_.fix_scale();
  BundlePose pose = second_pose;
  for (std::size_t i = 3; i < 6; ++i) pose[i] *= mean;
  filter_.set_pose(pose);
  filter_.predict(second - first - 1);
  return true;
}

std::vector<TrackPlace> FilterRun::places_in(int frame) const {
  std::vector<TrackPlace> out;
  for (const std::size_t track : active_)
    if (tracks_[track].in_frame(frame)) out.push_back({track, tracks_[track].in(frame)});
  return out;
}

// Points whose track has ended, and those whose places did not fit for long.
void FilterRun::remove_lost(int frame) {
  for (const FilteredPoint& point : filter_.points()) {
    const bool misfit = point.misses >= options_.most_misses;
    if (!misfit && tracks_[point.track].in_frame(frame)) continue;
    if (misfit) wrong_[point.track] = true;
    filter_.remove_point(point.track);
    active_.erase(point.track);
  }
}

void FilterRun::keep_estimates() {
  for (const FilteredPoint& point : filter_.points())
    estimates_[point.track] = PointEstimate{point.world, point.relative_spread};
}

int FilterRun::remaining(std::size_t track, int frame, Direction direction) const {
  return direction == Direction::forward ? tracks_[track].end_frame() - 1 - frame
                                         : frame - tracks_[track].first_frame;
}

void FilterRun::add_new(int frame, Direction direction) {
  const auto room = static_cast<std::size_t>(options_.most_points) - active_.size();
  std::vector<std::size_t> fresh;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (tracks_[i].in_frame(frame) && !active_.contains(i) && !wrong_[i] &&
        remaining(i, frame, direction) > 0)
      fresh.push_back(i);
  std::stable_sort(fresh.begin(), fresh.end(), [&](std::size_t a, std::size_t b) {
    return remaining(a, frame, direction) > remaining(b, frame, direction);
  });
  if (fresh.size() > room) fresh.resize(room);
  const double usual = filter_.median_inverse_depth();
  const auto camera_from_world = camera_pose(filter_.pose()).inverse();
  for (const std::size_t track : fresh) {
    const TrackPlace seen{track, tracks_[track].in(frame)};
    const auto& known = estimates_[track];
    const double depth = known ? (camera_from_world * Point<WorldFrame>{known->world}).v.z : 0.0;
    if (depth > 0)
      enter(track, seen, 1 / depth, known->relative_spread);
    else
      enter(track, seen, usual, options_.depth_spread);
  }
}

// From a frame to the last one in that direction; the state is that of the frame before.
Result<void> FilterRun::pass(int from, Direction direction, const Work& work) {
  const int count = static_cast<int>(poses_.size()), step = static_cast<int>(direction);
  for (int frame = from; frame >= 0 && frame < count; frame += step) {
    if (work.cancelled()) return Work::interrupted();
    filter_.predict(1);
    remove_lost(frame);
    auto& pose = poses_[static_cast<std::size_t>(frame)];
    pose.reset();
    if (filter_.update(places_in(frame)) == 0) continue;
    pose = filter_.pose();
    keep_estimates();
    // At the end the state is kept, for the way back.
    if (frame + step >= 0 && frame + step < count) remove_lost(frame + step);
    add_new(frame, direction);
    work.report(static_cast<double>(direction == Direction::forward ? frame : count - frame) / count,
                "finding the camera's path");
  }
  return {};
}

Result<void> FilterRun::turn_round(Direction direction, const Work& work) {
  const auto posed = [this](int frame) { return poses_[static_cast<std::size_t>(frame)].has_value(); };
  const int count = static_cast<int>(poses_.size()), step = static_cast<int>(direction);
  int start = direction == Direction::forward ? 0 : count - 1;
  while (start >= 0 && start < count && !posed(start)) start += step;
  if (start < 0 || start >= count) return {};
  add_new(start, direction);
  return pass(start + step, direction, work);
}

bool FilterRun::has_poses() const {
  return std::any_of(poses_.begin(), poses_.end(), [](const auto& pose) { return pose.has_value(); });
}

// The filter's own where it became certain; of tracks that were never in the state, by the poses.
std::optional<std::array<double, 3>> FilterRun::structure_point(std::size_t track,
                                                                const Pinhole& camera) const {
  if (wrong_[track]) return std::nullopt;
  std::vector<PosedObservation> observations;
  for (int frame = tracks_[track].first_frame; frame < tracks_[track].end_frame(); ++frame)
    if (const auto& pose = poses_[static_cast<std::size_t>(frame)])
      observations.push_back({*pose, tracks_[track].in(frame)});
  const auto& estimate = estimates_[track];
  if (!estimate)
    return triangulated_point(observations, camera, {options_.least_angle_deg, options_.outlier_px});
  if (estimate->relative_spread > options_.structure_spread) return std::nullopt;
  const std::array<double, 3> point{estimate->world.x, estimate->world.y, estimate->world.z};
  const bool fits = std::all_of(observations.begin(), observations.end(), [&](const PosedObservation& s) {
    return projection_error_px(camera, s.pose, point, s.place) <= options_.outlier_px;
  });
  return fits ? std::optional(point) : std::nullopt;
}

FoundMotion FilterRun::result() const {
  FoundMotion out;
  out.camera = filter_.camera();
  out.frames.resize(poses_.size());
  std::iota(out.frames.begin(), out.frames.end(), 0);
  out.poses = poses_;
  for (std::size_t i = 0; i < tracks_.size(); ++i) out.points.push_back(structure_point(i, out.camera));
  return out;
}

// Candidates for the pair that the filter begins with.
std::vector<int> spread_frames(int frame_count) {
  constexpr int kMost = 24;
  std::vector<int> out;
  for (int frame = 0; frame < frame_count; frame += std::max(1, frame_count / kMost)) out.push_back(frame);
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(FilterMotionOptions& o) {
  return {
      {"noise_px", &o.noise_px, {0.05, 10}, "px", "Standard deviation of a tracked place"},
      {"turn_deg", &o.turn_deg, {0.01, 20}, "degrees", "Standard deviation of the turn between frames"},
      {"step", &o.step, {0.0001, 1}, "", "Standard deviation of the movement between frames, in distances"},
      {"depth_spread", &o.depth_spread, {0.01, 2}, "", "Relative standard deviation of a new inverse depth"},
      {"focal_spread",
       &o.focal_spread,
       {0.01, 1},
       "",
       "Relative standard deviation of an unknown focal length"},
      {"gate", &o.gate, {1, 20}, "", "Standard deviations within which a place is used"},
      {"most_misses", &o.most_misses, {1, 100}, "", "Unused places in a row after which a point is lost"},
      {"most_points", &o.most_points, {10, 500}, "", "Points in the state"},
      {"least_points", &o.least_points, {6, 500}, "", "Points that a frame's pose needs"},
      {"iterations", &o.iterations, {1, 20}, "", "Linearisations of a frame's update"},
      {"passes", &o.passes, {1, 2}, "", "1: to the end, 2: and back to the beginning"},
      {"structure_spread",
       &o.structure_spread,
       {0.001, 1},
       "",
       "Less certain points are left out of the structure, relative"},
      {"least_angle_deg", &o.least_angle_deg, {0.1, 20}, "degrees", "Least angle between lines of sight"},
      {"outlier_px",
       &o.outlier_px,
       {0.1, 20},
       "px",
       "Points with larger errors are left out of the structure"}};
}

Result<CameraMotion> motion_by_filter(std::span<const PointTrack> tracks, int frame_count,
                                      const VideoCamera& camera, const FilterMotionOptions& options,
                                      const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  if (options.least_points > options.most_points)
    return Error{ErrorCode::usage, "more points are needed than the state may hold", "least_points"};
  const std::vector<int> frames = spread_frames(frame_count);
  BatchMotionOptions pair_options;
  pair_options.least_angle_deg = options.least_angle_deg;
  pair_options.outlier_px = options.outlier_px;
  pair_options.least_points = options.least_points;
  const auto pair = choose_first_pair(tracks, frames, camera.pinhole, pair_options, work);
  if (!pair) return pair.error();
  const int first = frames[static_cast<std::size_t>(pair->first)],
            second = frames[static_cast<std::size_t>(pair->second)];
  const Error lost = invalid_input(
      "the camera's path was lost: record it again, moving slowly around the model with all of it in view");
  FilterRun run(tracks, frame_count, camera, options);
  if (!run.begin(first, second, pair->second_pose)) return lost;
  // To the beginning with what the pair says, then the passes over all frames.
  if (const auto done = run.pass(second, Direction::backward, work); !done) return done.error();
  for (int pass = 0; pass < options.passes; ++pass) {
    const auto done = run.turn_round(pass % 2 == 0 ? Direction::forward : Direction::backward, work);
    if (!done) return done.error();
  }
  if (!run.has_poses()) return lost;
  return motion_result(run.result(), tracks);
}

}  // namespace palpable::vision
