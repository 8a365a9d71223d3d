// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/measure/structure_score.hpp"
#include "palpable/session/make/camera_poses.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/solid/mesh_file.hpp"
#include "palpable/sources/solid/points_file.hpp"

#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct StructureArguments {
  std::string result, truth;
  std::string poses, true_poses, calibration;
  double within_percent = 1.0;
};

/// A file without triangles may contain points.
Result<measure::TrueSurface> read_true_surface(const std::filesystem::path& file) {
  auto mesh = sources::read_mesh(file);
  if (mesh) return measure::TrueSurface(std::move(mesh->mesh));
  if (file.extension() != ".ply") return mesh.error();
  auto points = sources::read_points(file);
  if (!points) return points.error();
  return measure::TrueSurface(*std::move(points));
}

/// The same pose in a world of that name.
template <class World>
Transform<World, CameraFrame> in_world(const session::CameraPoses::mapped_type& pose) {
  return {pose.rotation, pose.translation_m, pose.scale};
}

struct Paths {
  measure::CameraPathScore score;
  std::vector<measure::TrueCamera> cameras;
};

Result<Paths> compare_paths(const StructureArguments& arguments) {
  const auto found = session::read_camera_poses(arguments.poses);
  if (!found) return found.error();
  const auto truth = session::read_camera_poses(arguments.true_poses);
  if (!truth) return truth.error();
  std::optional<Pinhole> pinhole;
  if (!arguments.calibration.empty()) {
    const auto calibration = sources::read_calibration(arguments.calibration);
    if (!calibration) return calibration.error();
    pinhole = sources::pinhole_of(calibration->left);
  }
  Paths out;
  std::vector<measure::FoundPose> found_poses;
  std::vector<measure::TruePose> true_poses;
  for (const auto& [frame, pose] : *found)
    found_poses.push_back({static_cast<int>(frame), in_world<WorldFrame>(pose)});
  for (const auto& [frame, pose] : *truth) {
    true_poses.push_back({static_cast<int>(frame), in_world<measure::TrueWorldFrame>(pose)});
    out.cameras.push_back({true_poses.back().pose, pinhole});
  }
  auto score = measure::score_camera_path(found_poses, true_poses);
  if (!score) return Error{score.error().code, score.error().message, arguments.poses};
  out.score = *score;
  return out;
}

std::string text_of(const measure::CameraPathScore& s) {
  return fmt::format(
      "{} poses compared, {} missing: position RMS {:.3f} % of the path, rotation {:.3f}° in the mean, "
      "{:.3f}° "
      "at most\n",
      s.frames, s.missing_frames, s.position_rms_percent, s.mean_rotation_deg, s.most_rotation_deg);
}

Json json_of(const measure::CameraPathScore& s) {
  return {{"frames", s.frames},
          {"missing_frames", s.missing_frames},
          {"path_length", s.path_length},
          {"position_rms_percent", s.position_rms_percent},
          {"mean_rotation_deg", s.mean_rotation_deg},
          {"most_rotation_deg", s.most_rotation_deg},
          {"true_from_found", matrix_of(s.true_from_found)}};
}

std::string text_of(const measure::StructureScore& s, double within_percent) {
  const std::string visible =
      s.visible_completeness_percent
          ? fmt::format(", {:.1f} % of what a camera can see", *s.visible_completeness_percent)
          : std::string();
  return fmt::format(
      "{} points, diagonal {:.4g}; percent of the diagonal:\n"
      "distance from the true surface: RMS {:.3f} % ({:.3f} % truncated), median {:.3f} %\n"
      "true surface with a point within {:g} %: {:.1f} %{}\n",
      s.points, s.diagonal, s.accuracy_rms_percent, s.accuracy_truncated_rms_percent,
      s.accuracy_median_percent, within_percent, s.completeness_percent, visible);
}

Result<Answer> score_structure(const StructureArguments& arguments, Console& console) {
  if (!arguments.calibration.empty() && arguments.true_poses.empty())
    return Error{ErrorCode::usage, "only with poses", "--calibration"};
  if (arguments.poses.empty() != arguments.true_poses.empty())
    return Error{ErrorCode::usage,
                 "both are needed for an alignment, the poses that were found and the true ones",
                 arguments.poses.empty() ? "--poses" : "--true-poses"};
  const auto found = sources::read_points(arguments.result);
  if (!found) return found.error();
  const auto truth = read_true_surface(arguments.truth);
  if (!truth) return truth.error();
  std::optional<Paths> paths;
  if (arguments.poses.empty()) {
    console.note("Without poses nothing is aligned: both files were compared in their own coordinates.");
  } else {
    auto compared = compare_paths(arguments);
    if (!compared) return compared.error();
    paths = *std::move(compared);
  }
  measure::StructureScoreOptions options;
  options.found_within = arguments.within_percent / 100;
  const auto score = measure::score_structure(
      *found, paths ? paths->score.true_from_found : Transform<measure::TrueWorldFrame, WorldFrame>{}, *truth,
      paths ? paths->cameras : std::vector<measure::TrueCamera>{}, options, console.work());
  if (!score) return Error{score.error().code, score.error().message, arguments.result};
  Answer answer;
  answer.json = {
      {"aligned_by_poses", paths.has_value()},
      {"points", score->points},
      {"diagonal", score->diagonal},
      {"accuracy_rms_percent", score->accuracy_rms_percent},
      {"accuracy_truncated_rms_percent", score->accuracy_truncated_rms_percent},
      {"accuracy_median_percent", score->accuracy_median_percent},
      {"completeness_percent", score->completeness_percent},
      {"visible_completeness_percent",
       score->visible_completeness_percent ? Json(*score->visible_completeness_percent) : Json(nullptr)},
      {"path", paths ? json_of(paths->score) : Json(nullptr)}};
  answer.text = (paths ? text_of(paths->score) : std::string()) + text_of(*score, arguments.within_percent);
  return answer;
}

}  // namespace

void add_score_structure(Program& program) {
  const auto arguments = std::make_shared<StructureArguments>();
  Options options = add_command_below(
      program, "score", "structure", "Points found in a video, and its camera path, against the truth",
      "  palpable score structure points.ply model.obj --poses poses.csv --true-poses truth.csv "
      "--calibration camera.json\n"
      "  palpable score structure aligned.ply scan.ply",
      [arguments](Console& console) { return score_structure(*arguments, console); });
  options.argument("RESULT", arguments->result, "Points, .ply, as make --structure writes them");
  options.argument("TRUTH", arguments->truth,
                   "The true surface: triangles (.obj, .ply, .stl, .glb) or points (.ply)");
  options.text("--poses", arguments->poses,
               "The poses that were found, as make --poses writes them: they align the result");
  options.text("--true-poses", arguments->true_poses,
               "The true poses in the truth's coordinates, frame,qw,qx,qy,qz,tx,ty,tz");
  options.text("--calibration", arguments->calibration,
               "The camera of the video: only what is in its pictures counts as visible");
  options.number("--within", arguments->within_percent, {0.01, 50},
                 "Distance within which a true place counts as found, percent of the diagonal");
}

}  // namespace palpable::cli
