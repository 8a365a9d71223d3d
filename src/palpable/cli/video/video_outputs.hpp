// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/cli/options.hpp"
#include "palpable/core/files/atomic_files.hpp"
#include "palpable/core/result.hpp"
#include "palpable/recipes/video/video_recipe.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// The outputs of a video in addition to its scene; empty = not written.
struct VideoOutputs {
  /// Poses of the cameras, CSV.
  std::string poses;
  /// Points on the surfaces, PLY.
  std::string structure;
  /// A folder: depth maps as 16-bit PNG, and depth.json with their scale.
  std::string depth_folder;
  /// A page about the video and its result, HTML.
  std::string report;
  /// The coloured surface, GLB.
  std::string mesh;
};
void add_video_outputs(Options& options, VideoOutputs& outputs);

/// What a video became.
struct VideoResult {
  /// Of the video's file or folder.
  std::string name;
  const recipes::VideoReconstruction& video;
  const models::Scene& scene;
  const std::vector<Note>& notes;
};

/// The name of the video's file or folder.
std::string video_name(const std::vector<std::string>& inputs);

/// Whether these inputs are one video, or the folder of a sequence. Then --poses is an output, else an input.
bool is_video(const std::vector<std::string>& inputs, const std::string& kind);

/// Checks before any work that the folder of depth maps, which output_files.hpp has checked, is a new one or
/// holds those of an earlier run. Errors: usage.
Result<void> check_video_outputs(const VideoOutputs& outputs);

/// The check for inputs that are no video, which have none of these outputs. Errors: of reading, for an
/// output that is given with a file that cannot be read; otherwise usage for an output that is given.
Result<void> check_no_video_outputs(const VideoOutputs& outputs, const std::vector<std::string>& inputs);

/// The steps in which a video's corrected model was refined: kind, frame, mean distance of the measured
/// points from the surface in metres of the scene, and whether the step was taken.
Json steps_of(const recipes::VideoReconstruction& video);

/// Adds the outputs to the command's files, which appear together. Errors: failed, as AtomicFiles::add(),
/// video_report() and video_glb().
Result<void> add_video_outputs(const VideoOutputs& outputs, const VideoResult& result, AtomicFiles& files,
                               const Work& work);

}  // namespace palpable::cli
