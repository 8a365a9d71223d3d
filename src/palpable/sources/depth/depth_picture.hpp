// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/depth/colour_registration.hpp"
#include "palpable/sources/depth/zbuffer.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace palpable::sources {

/// The meaning of the numbers in a depth file.
enum class DepthMeaning : std::uint8_t {
  /// Along the camera's axis, in units of metres_per_unit.
  depth,
  /// Distance along each pixel's ray; needs the camera.
  distance,
  /// Stereo disparity, in units of px_per_unit.
  disparity,
  /// Larger is nearer, without unit (a grey picture of depth, as shown on screens).
  nearness,
  /// A renderer's depth buffer; needs its near and far planes.
  zbuffer
};

/// "depth", "distance", …; and back, nullopt for an unknown name.
std::string_view name_of(DepthMeaning meaning);
std::optional<DepthMeaning> depth_meaning_from(std::string_view name);

/// Settings of a depth file, from options or a sidecar. Settings that are not given are detected, or have the
/// defaults of docs/formats.md.
struct DepthSettings {
  std::optional<DepthMeaning> meaning;
  std::optional<double> metres_per_unit;
  std::optional<double> px_per_unit;
  std::optional<ZBuffer> zbuffer;
  /// The depth camera.
  std::optional<Pinhole> camera;
  /// The camera of the colour picture, if it is another one.
  std::optional<ColourCamera> colour;
};

/// The settings of `first`; those that it does not contain, from `otherwise`.
DepthSettings merged(DepthSettings first, const DepthSettings& otherwise);

/// The settings in a JSON text: `meaning`, `metres_per_unit` (or `scale`: the same, or, above 1, units of a
/// metre), `px_per_unit`, `near_m`, `far_m`, `range`, `order`, `projection`, `far_plane`, a camera's `fx, fy,
/// cx, cy, width, height`, and `colour` with a camera, `rotation` (9 numbers) and `translation_m` (3).
/// Unknown keys are ignored. Errors: invalid_input.
Result<DepthSettings> decode_depth_settings(std::string_view json);

/// The names under which a depth file's sidecar may be: FILE.json, FILE with the suffix .json, and depth.json
/// in its folder, without the file itself.
std::vector<std::filesystem::path> depth_sidecars_of(const std::filesystem::path& file);

/// Reads the sidecar of a depth file: the first of depth_sidecars_of() that is a file. Empty settings if
/// there is none. Errors: invalid_input, naming the sidecar.
Result<DepthSettings> read_depth_sidecar(const std::filesystem::path& file);

/// A depth file, read and interpreted.
struct DepthPicture {
  /// Metres if they are known; else disparity, of which only the shape is used.
  std::variant<DepthMap, DisparityMap> depth;
  /// The picture of the same pixels; alpha 0 where there is no colour.
  std::optional<Image> colour;
  std::size_t unknown = 0;
  /// Assumptions that were made.
  std::vector<Note> notes;
};

/// Reads depth from one file (numbers; a picture with depth in its alpha channel; a phone's photograph with
/// depth inside; a grey picture), or from two, colour first. `settings` override a sidecar. Errors:
/// invalid_input or usage, with the file's name: unreadable, no known pixel, planes or camera missing where
/// they are needed, two pictures that do not match.
Result<DepthPicture> read_depth_picture(std::span<const std::filesystem::path> files,
                                        const DepthSettings& settings = {});

}  // namespace palpable::sources
