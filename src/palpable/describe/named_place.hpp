// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/models/scene/place_name.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace palpable::describe {

/// A place of a scene that can be asked for: that a person named, or that the program found and a person may
/// name. Street maps, regions, lines, bodies and hills all become this.
struct NamedPlace {
  /// What it is called, where it is and what it covers.
  models::PlaceName name;
  /// As it is said: "St Mary, church".
  std::string words = {};
  /// The kind of a special place of a map.
  std::optional<MapPlace::Kind> kind = {};
  /// Whether it is felt; otherwise there is no room for it.
  bool felt = true;
  /// Its index in Scene::names; nullopt: the program found it.
  std::optional<std::size_t> written = {};
};

}  // namespace palpable::describe
