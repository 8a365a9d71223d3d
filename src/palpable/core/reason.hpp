// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable {

/// Why something could not be done, or was done with an assumption, where the caller can change that. A
/// message states the fact; how to change it depends on who asks: the command line names its option, a
/// program sets the field of an options struct.
enum class Reason : std::uint8_t {
  /// Nothing that an option would change.
  unspecified,
  /// The cameras are unknown: a calibration is needed, or would make the result metric.
  needs_calibration,
  /// The distance between the two positions of one moved camera is unknown.
  needs_camera_movement,
  /// The scale of a depth file was assumed.
  depth_scale_assumed,
  /// What the numbers of a depth file mean was assumed.
  depth_meaning_assumed,
  /// Both of them were assumed.
  depth_numbers_assumed,
  /// A depth buffer needs its near and far planes.
  needs_clip_planes,
  /// No edges were found that show a plane's perspective: the plane has to be marked.
  needs_plane_marks,
  /// The kind of the input does not allow this; it may have been recognised wrongly.
  unexpected_input_kind,
  /// A photograph with depth inside was taken as depth, not as a picture.
  photo_depth_used,
  /// Ways to store a field were given for a scene that is not one.
  needs_field,
  /// No ground was found that could be treated.
  no_ground_found,
  /// Ground and background cannot be found in this kind of input.
  no_regions_in_input,
  /// A label picture was given for input without pixels.
  labels_without_pixels,
  /// The TCP port is in use.
  port_in_use
};

}  // namespace palpable
