// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/core/atomic_files.hpp"
#include "palpable/core/result.hpp"
#include "palpable/recipes/video_recipe.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// What is written beside the scene of a video.
struct VideoOutputs {
  /// Poses of the cameras, CSV.
  std::string poses;
  /// Points on the surfaces, PLY.
  std::string structure;
  /// A folder: depth maps as 16-bit PNG, and depth.json with their scale.
  std::string depth_folder;
};
void add_video_outputs(Options& options, VideoOutputs& outputs);

/// Whether these inputs are one film, or the folder of a sequence: --poses is then written, else read.
bool is_video(const std::vector<std::string>& inputs, const std::string& kind);

/// Whether all of them can be written, asked before any work is done. `files`: the inputs and every other
/// file of the command line, none of which may be overwritten. Errors: usage for outputs where `video` is
/// false (the input is none), for a file that is one of `files`, a folder that is missing or holds other
/// files; failed where there is no room.
Result<void> check_video_outputs(const VideoOutputs& outputs, bool video,
                                 const std::vector<std::string>& files);

/// Adds them to the files of the command, which appear together. Errors: failed, as AtomicFiles::add().
Result<void> add_video_outputs(const VideoOutputs& outputs, const recipes::VideoReconstruction& video,
                               AtomicFiles& files);

}  // namespace palpable::cli
