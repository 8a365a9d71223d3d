// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/name_history.hpp"
#include "palpable/describe/place_guide.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>

namespace palpable::page {

/// The names of a touch as its pages list, edit and find them. One thread.
class PageNames {
 public:
  /// The answer to a question about the names around a place.
  protocol::Around around(const models::Scene& scene, const protocol::LookAround& question);

  /// What the scene's names become by a page's edit, and what is said of it. Errors: usage, in words.
  Result<describe::NamesEdit> edited(const models::Scene& scene, const protocol::Name& name);
  Result<describe::NamesEdit> edited(const models::Scene& scene, const protocol::Unname& name);
  Result<describe::NamesEdit> edited(const models::Scene& scene, const protocol::UndoName& undo);

  /// The level of the notice of an edit: a page can undo "named".
  template <class Edit>
  static const char* level_of(const Edit& /*edit*/) {
    return std::is_same_v<Edit, protocol::UndoName> ? "answer" : "named";
  }

  /// From now on a probe is led to a place, or no longer; the place as it is seen from where the probe is.
  /// Errors: usage for a place that is no longer there.
  Result<std::optional<describe::PlaceGuide::Seen>> find(const models::Scene& scene,
                                                         const protocol::Find& find);
  /// The way of a probe to the place that it is led to, in words: "tall hill: 12 millimetres right"; at its
  /// end the name with its sentence, until find() ends it: keys may only pass by. Empty if it is not led.
  protocol::Words way(const models::Scene& scene, const protocol::Ask& ask);
  /// Where a probe is led; nullopt: nowhere, or it has arrived.
  std::optional<describe::PlaceGuide::Seen> seen(const models::Scene& scene, std::size_t probe, Place from);

  /// What has a name in the scene.
  const describe::PlaceGuide& guide(const models::Scene& scene);

 private:
  /// The index of the target of a probe among the guide's places now; nullopt if it is gone.
  std::optional<std::size_t> target(const models::Scene& scene, std::size_t probe);
  Result<std::optional<std::size_t>> place_in_list(const models::Scene& scene, std::int64_t list,
                                                   std::optional<std::int64_t> place);

  std::unique_ptr<const describe::PlaceGuide> guide_;
  /// Of the names that the guide found.
  describe::Language language_ = describe::Language::english;
  /// Rises with each new guide.
  std::int64_t list_ = 0;
  describe::NameHistory history_;
  std::array<std::optional<models::PlaceName>, protocol::kMostProbes> targets_;
};

}  // namespace palpable::page
