// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/live/frame_size.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sources {

/// A picture of a live source from its file. Errors, without a place: as decode_picture() and
/// check_frame_size().
Result<Image> decode_frame_picture(std::span<const std::byte> file);

/// The names of one frame's files.
struct FrameNames {
  /// Empty for a pair.
  std::string depth;
  /// The left picture of a pair; otherwise empty if there is none.
  std::string colour;
  /// The right picture of a pair; otherwise empty.
  std::string right = {};
  /// Where the camera was; empty if that is not stated.
  std::string pose = {};
};

/// The frames among the names of a folder's files, in the order of their names (counted_before()); pairs
/// only if there are no depth maps.
std::vector<FrameNames> frames_among(const std::set<std::string>& names);

/// The frames of a camera in a folder, in the order of their names. Of a depth camera: NAME.depth.png with
/// NAME.color.png, .jpg or .jpeg beside it, and where the camera was in NAME.pose.txt. The camera is that of
/// the sidecar, else of intrinsics.K.txt or camera-intrinsics.txt, 3 x 3 numbers, row by row. What the
/// numbers mean is stated by a sidecar (read_depth_sidecar(); without one they are millimetres). Of a stereo
/// camera: NAME.left.png and NAME.right.png, or .jpg or .jpeg.
class FrameFolder {
 public:
  /// Lists the frames; reads none. Errors: invalid_input, naming the folder or the sidecar: unreadable,
  /// without frames, a sidecar that does not state depth or distance along the axis, a file of intrinsics
  /// that is none.
  static Result<FrameFolder> open(const std::filesystem::path& folder);

  std::size_t size() const { return frames_.size(); }
  /// The frames are of a stereo camera: they have pairs of pictures and no depth.
  bool has_pairs() const { return frames_.front().depth.empty(); }
  /// The pictures of pair `k` < size(), left first. Errors: as decode_picture(), and for more than
  /// kMostFramePixels; invalid_input for a pipe.
  Result<std::pair<Image, Image>> pair(std::size_t k) const;
  /// The depth of frame `k` < size(), with the camera if it is stated and of that size; all unknown if the
  /// camera saw nothing. Never waits for another program.
  /// Errors: as decode_raster(); invalid_input for a pipe, and for more than kMostFramePixels.
  Result<DepthMap> depth(std::size_t k) const;
  /// The camera's pose for frame `k` < size(), from 4 x 4 numbers, row by row; nullopt if none is stated.
  /// Errors: invalid_input for a pipe, and for numbers that are no pose.
  Result<std::optional<Transform<WorldFrame, palpable::CameraFrame>>> pose(std::size_t k) const;
  /// Its colour picture. Errors: as decode_picture(); invalid_input for a pipe, or if there is none.
  Result<Image> colour(std::size_t k) const;

 private:
  Result<Image> picture(const std::string& name) const;

  std::filesystem::path folder_;
  std::vector<FrameNames> frames_;
  double metres_per_unit_ = 0.001;
  /// Its size is 0 x 0 if only the matrix is stated: then it is that of every frame.
  std::optional<Pinhole> camera_;
};

}  // namespace palpable::sources
