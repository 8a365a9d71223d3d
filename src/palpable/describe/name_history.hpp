// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/place_guide.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace palpable::describe {

/// A change of a scene's names, and what is said of it.
struct NamesEdit {
  models::PlaceNames names;
  std::string words;
};

/// Edits the names of a scene in a touch; each edit can be undone. It keeps no names but those before and
/// after edits: the caller puts NamesEdit::names into the scene. One thread.
class NameHistory {
 public:
  /// Names the point `given.at`, or with `place` one of the guide's places, which gets the given name and
  /// sentence. Errors: usage as models::with_name(), and for a place that the guide does not have.
  Result<NamesEdit> name(const models::Scene& scene, const PlaceGuide& guide, models::PlaceName given,
                         std::optional<std::size_t> place = {});
  /// Deletes a written name. Errors: usage for a place that nobody named, or that the guide does not have.
  Result<NamesEdit> remove(const models::Scene& scene, const PlaceGuide& guide, std::size_t place);
  /// Errors: usage if there is nothing to undo or redo.
  Result<NamesEdit> undo(const models::Scene& scene);
  Result<NamesEdit> redo(const models::Scene& scene);

 private:
  struct Step {
    models::PlaceNames names;
    /// "naming tall hill"
    std::string what;
  };
  void keep(const models::Scene& scene, std::string what);

  std::vector<Step> past_;
  std::vector<Step> future_;
};

}  // namespace palpable::describe
