// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/named_place.hpp"
#include "palpable/models/scene/scene.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::describe {

/// Half the width of what a written point covers, as a share of the scene's longer side: 3 mm of 100 mm, more
/// than half a long step of the keys. Of a line: 1 mm.
inline constexpr double kPointReach = 0.03;
inline constexpr double kLineReach = 0.01;
double longer_side_m(const models::Scene& scene);

/// The distance from a place to what a name covers, and the place there: 0 inside. Of a label only 0 or
/// infinity is known.
models::OnLine nearest_of(const models::Scene& scene, const models::PlaceName& name, Place from);

/// The written name that covers a place: the nearest point, else a line, else the smallest area, else a
/// label; nullptr if there is none. Any thread; cheap.
const models::PlaceName* written_at(const models::Scene& scene, Place place);

/// What of a scene has a name or can be given one: written names, then streets and places of a map, regions,
/// lines, bodies and hills that the program finds. A written name takes the place of what it was given to.
/// Immutable; any thread. Making it searches the scene, which takes up to some tenths of a second.
class PlaceGuide {
 public:
  explicit PlaceGuide(const models::Scene& scene);

  /// Whether it still describes this scene.
  bool is_of(const models::Scene& scene) const;
  const std::vector<NamedPlace>& places() const noexcept { return places_; }

  /// A place as it is seen from another one.
  struct Seen {
    /// Index of places().
    std::size_t place = 0;
    /// Its nearest point, and how far away that is; 0 within its reach.
    Place at;
    double distance_m = 0.0;
  };
  /// `place`: an index of places().
  Seen seen(std::size_t place, Place from) const;
  /// All of them, the nearest first.
  std::vector<Seen> around(Place from) const;

  /// Those that cover a place (seen() at 0 m), points first, then lines, areas and labels.
  std::vector<std::size_t> here(Place place) const;

  /// The place that is called so; of several the nearest one. Case does not count; the beginning of a name,
  /// or one letter in five wrong, is enough where only one name fits. Errors: usage with the names that fit,
  /// or with similar ones.
  Result<std::size_t> find(std::string_view name, Place from) const;

 private:
  /// Adds what was found, unless a written name has taken its place.
  void add_found(const models::Scene& scene, NamedPlace place);
  /// The nearest sample of each label.
  std::vector<models::OnLine> nearest_labels(Place from) const;
  Seen seen(std::size_t place, Place from, const std::vector<models::OnLine>& labels) const;

  models::Model model_;
  models::PlaceNames written_;
  std::vector<NamedPlace> places_;
  /// The label of each place; nullopt: it is none.
  std::vector<std::optional<std::size_t>> label_of_;
  /// The scene's labels, reduced.
  Raster<std::uint8_t> labels_;
  Vec3 size_m_;
  double reach_m_ = 0.0;
};

/// "32 millimetres left, 12 millimetres up"; "here" within reach.
std::string way_words(const PlaceGuide::Seen& seen, Place from);
/// "Here: tall hill. Around: low hill, 20 millimetres right; …", at most `most` names.
std::string around_words(const PlaceGuide& guide, Place from, std::size_t most);

}  // namespace palpable::describe
