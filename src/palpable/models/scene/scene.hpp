// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/models/contours/contours.hpp"
#include "palpable/models/field/field.hpp"
#include "palpable/models/grid/grid.hpp"
#include "palpable/models/material/material.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/place_name.hpp"
#include "palpable/models/scene/route_guide.hpp"
#include "palpable/models/scene/second_view.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace palpable {
struct StreetMap;
}

namespace palpable::models {

/// The frame of the input: pixels of a picture (x right, y down, z = depth or disparity as read) or a mesh's
/// own metres.
struct InputFrame;

/// A touchable model; new kinds are added here.
using Model =
    std::variant<std::shared_ptr<const Relief>, std::shared_ptr<const Contours>, std::shared_ptr<const Field>,
                 std::shared_ptr<const Grid>, std::shared_ptr<const FieldOnLattice>>;

/// "relief", "field", … as `palpable info` prints it.
std::string kind_of(const Model& model);

/// Whether it is a distance field, adaptive or dense.
bool is_field(const Model& model) noexcept;

/// A file that a scene was made from, as it was then.
struct SourceFile {
  /// As the command line named it.
  std::string name;
  std::uint64_t bytes = 0;
  /// 64 hexadecimal digits.
  std::string sha256;
};

/// Where a scene came from; stored in its file so that a result is traceable and can be made again.
struct Provenance {
  std::vector<std::string> inputs;
  /// The method and its options, in words.
  std::string method;
  std::string made_by;
  /// The command line that made it, without the program and the files that it wrote: "make", "left.png", ….
  /// Empty: not known.
  std::vector<std::string> command;
  /// The files that the command names and their sidecars; empty if the command is not known.
  std::vector<SourceFile> files;
};

/// Most words of a scene's command and bytes of each, and most files.
inline constexpr std::size_t kMaxCommandWords = 10000;
inline constexpr std::size_t kMaxCommandWordBytes = 4096;
inline constexpr std::size_t kMaxSourceFiles = 10000;

/// Longest title and description that a scene may have, bytes of UTF-8.
inline constexpr std::size_t kMaxTitleBytes = 200;
inline constexpr std::size_t kMaxDescriptionBytes = 4000;
/// Most warnings that a scene may have, and bytes of UTF-8 of each.
inline constexpr std::size_t kMaxWarnings = 16;
inline constexpr std::size_t kMaxWarningBytes = 1000;

/// How the solid of a field lies. Upright: y is up and z towards the person, who is before it. Flat: z is up,
/// seen from above. Other models are surfaces that rise towards the person.
enum class SolidPose : std::uint8_t { upright, flat };

/// A touchable scene as it is saved: a model, its picture, materials and origin. A value type; models are
/// shared and immutable.
struct Scene {
  /// Set it before use: it begins without one, and only has_model() may be asked of such a scene.
  Model model;
  /// Shown on the surface, covering the model's rectangle; may be empty.
  Raster<Rgb8> texture;
  /// Of a relief from a pair, what the right eye sees; null: the texture.
  std::shared_ptr<const SecondView> second_view;
  /// At least one; label k of `labels` uses materials[k].
  std::vector<Material> materials{Material{}};
  /// Material index per sample, over the same rectangle as the texture; empty = all 0.
  Raster<std::uint8_t> labels;
  Transform<SceneFrame, InputFrame> scene_from_input;
  SolidPose pose = SolidPose::upright;
  /// The streets, places and words of a street map, in pixels of the input; null for other scenes.
  std::shared_ptr<const StreetMap> map;
  /// A way along which laws pull the hand while it touches the surface; null: none. Not part of a scene's
  /// file.
  std::shared_ptr<const RouteGuide> guide;
  Provenance source;
  /// The maker's title (one line) and description, which are spoken and shown before the scene is touched.
  /// UTF-8; both may be empty.
  std::string title;
  std::string description;
  /// What of this scene cannot be trusted, as measured when it was made: whole sentences, the gravest first.
  /// Said with the description, and again whenever the saved scene is used.
  std::vector<std::string> warnings;
  /// What persons called its points and regions, in the order in which they did.
  PlaceNames names;
};

/// Whether the scene's model has been set.
bool has_model(const Scene& scene) noexcept;

/// Index of the material at a place of the scene, seen from above: always a valid index of scene.materials.
/// Outside the scene that of the nearest place. Any thread; never allocates.
std::size_t label_at(const Scene& scene, Point<SceneFrame> place);

/// The surface of a scene: a relief itself, the grooves of contours, or a field or grid seen from above.
/// Never null.
const std::shared_ptr<const Relief>& relief_of(const Scene& scene);

/// Width, height and depth in metres of the scene's bounding box.
Vec3 size_m(const Scene& scene);

/// Whether its solid stands upright: its extents are then wide, high and deep along x, y and z.
bool is_upright_solid(const Scene& scene) noexcept;

/// The middle of that box.
Vec3 centre_m(const Scene& scene);

}  // namespace palpable::models
