// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/name_history.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/place_words.hpp"

#include <utility>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

Error no_such_place() { return {ErrorCode::usage, tr("the names have changed: list them anew"), {}}; }

/// "upper left": where in the scene.
std::string part_of_scene(const models::Scene& scene, Place at) {
  const Vec3 size = models::size_m(scene), centre = models::centre_m(scene);
  return region_words({at.x_m - centre.x, at.y_m - centre.y}, size.x, size.y);
}

}  // namespace

void NameHistory::keep(const models::Scene& scene, std::string what) {
  constexpr std::size_t kMost = 200;
  if (past_.size() == kMost) past_.erase(past_.begin());
  past_.push_back({scene.names, std::move(what)});
  future_.clear();
}

Result<NamesEdit> NameHistory::name(const models::Scene& scene, const PlaceGuide& guide,
                                    models::PlaceName given, std::optional<std::size_t> place) {
  std::optional<std::size_t> replaced;
  std::string before;
  if (place) {
    if (*place >= guide.places().size()) return no_such_place();
    const NamedPlace& known = guide.places()[*place];
    replaced = known.written;
    before = known.name.name;
    given.at = known.name.at;
    given.extent = known.name.extent;
    given.line = known.name.line;
  }
  auto names = models::with_name(scene.names, std::move(given), replaced);
  if (!names) return names.error();
  const models::PlaceName& now = replaced ? (*names)[*replaced] : names->back();
  keep(scene, phrase("naming {}", now.name));
  if (!before.empty() && before != now.name)
    return NamesEdit{*names, phrase("{} is now called {}.", before, now.name)};
  return NamesEdit{*names, phrase("Named: {}, {}.", now.name, part_of_scene(scene, now.at))};
}

Result<NamesEdit> NameHistory::remove(const models::Scene& scene, const PlaceGuide& guide,
                                      std::size_t place) {
  if (place >= guide.places().size()) return no_such_place();
  const NamedPlace& known = guide.places()[place];
  if (!known.written)
    return Error{ErrorCode::usage,
                 phrase("{} was found by the program: it can be renamed, not deleted", known.name.name),
                 {}};
  models::PlaceNames names = scene.names;
  names.erase(names.begin() + static_cast<std::ptrdiff_t>(*known.written));
  keep(scene, phrase("deleting {}", known.name.name));
  return NamesEdit{std::move(names), phrase("Deleted: {}.", known.name.name)};
}

Result<NamesEdit> NameHistory::undo(const models::Scene& scene) {
  if (past_.empty()) return Error{ErrorCode::usage, tr("there is no change of a name to undo"), {}};
  Step step = std::move(past_.back());
  past_.pop_back();
  future_.push_back({scene.names, step.what});
  return NamesEdit{std::move(step.names), phrase("Undone: {}.", step.what)};
}

Result<NamesEdit> NameHistory::redo(const models::Scene& scene) {
  if (future_.empty()) return Error{ErrorCode::usage, tr("there is no change of a name to redo"), {}};
  Step step = std::move(future_.back());
  future_.pop_back();
  past_.push_back({scene.names, step.what});
  return NamesEdit{std::move(step.names), phrase("Redone: {}.", step.what)};
}

}  // namespace palpable::describe
