// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/describe/name_history.hpp"
#include "palpable/formats/scene/unsaved_scene.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace palpable::cli {

/// Names in a touch by keys: what is around, naming, finding. One thread.
class KeyNames {
 public:
  /// `save_as`: the scene file that save() writes.
  explicit KeyNames(std::filesystem::path save_as) : unsaved_(std::move(save_as)) {}

  /// The scene with the names that were edited.
  std::shared_ptr<const models::Scene> named(const std::shared_ptr<const models::Scene>& touched);

  // Each returns what to say. `scene`: as named() gives it; `from`: where the probe is.

  /// All names, one line each, the nearest first.
  std::string list(const models::Scene& scene, Place from);
  /// A line "NAME" or "NAME: SENTENCE" names the probe's place; an empty line names nothing.
  std::string name(const models::Scene& scene, Place at, std::string_view line);
  /// From now on the probe is led to the place of this name.
  std::string find(const models::Scene& scene, Place from, std::string_view line);
  /// The way to the place that is looked for; at its end the place itself. Empty if none is.
  std::string way(const models::Scene& scene, Place from);
  std::string undo(const models::Scene& scene);
  std::string save(const models::Scene& scene);
  /// Where an earlier touch left names that were not saved; empty if it did not.
  std::string left_over_words() const;
  /// Where names are kept that were not saved; empty if there are none.
  std::string unsaved_words() const;
  /// Errors: failed, if names were given that are neither saved nor kept.
  Result<void> none_lost() const;

 private:
  const describe::PlaceGuide& guide(const models::Scene& scene);
  std::string taken(const models::Scene& scene, Result<describe::NamesEdit> edit);

  formats::UnsavedScene unsaved_;
  describe::NameHistory history_;
  std::optional<models::PlaceNames> edited_;
  /// As they were last opened or saved.
  std::optional<models::PlaceNames> touched_names_;
  std::shared_ptr<const models::Scene> touched_;
  std::shared_ptr<const models::Scene> named_;
  std::unique_ptr<const describe::PlaceGuide> guide_;
  std::optional<models::PlaceName> target_;
};

}  // namespace palpable::cli
