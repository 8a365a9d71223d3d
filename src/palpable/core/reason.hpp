// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace palpable {

/// Why something failed, or was done under an assumption, if the caller can change that. The message states
/// the fact. How to change it depends on the caller: the command line names an option, a program sets a field
/// of an options struct.
enum class Reason : std::uint8_t {
  /// None of the following; the message says all that is known.
  unspecified,
  /// The cameras are unknown: a calibration is needed, or would make the result metric.
  needs_calibration,
  /// The distance between the two positions of one moved camera is unknown.
  needs_camera_movement,
  /// The scale of a depth file was assumed.
  depth_scale_assumed,
  /// The meaning of the numbers in a depth file was assumed.
  depth_meaning_assumed,
  /// Both were assumed.
  depth_numbers_assumed,
  /// A depth buffer needs its near and far planes.
  needs_clip_planes,
  /// No edges were found that determine a plane's perspective: the plane must be marked.
  needs_plane_marks,
  /// The kind of the input does not allow this; it may have been recognised wrongly.
  unexpected_input_kind,
  /// A photograph with depth inside was taken as depth, not as a picture.
  photo_depth_used,
  /// Options of a distance field were given for another kind of scene.
  needs_field,
  /// No ground plane was found.
  no_ground_found,
  /// Ground and background cannot be found in this kind of input.
  no_regions_in_input,
  /// A label picture was given for an input without pixels.
  labels_without_pixels,
  /// The TCP port is in use.
  port_in_use,
  /// The machine does not keep the loop's rate.
  rate_not_kept,
  /// A device does not answer; what stands in its way can be examined.
  device_silent,
  /// A street map shows more than can be felt at this size.
  map_too_dense,
  /// The part of a street map was chosen by the program.
  map_part_chosen
};

}  // namespace palpable
