// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_names.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace palpable::page {
namespace {

/// Entries that say the same get their number and their place: "bench, here, 1 of 2, 3 millimetres right from
/// the middle". `seen`: of each entry.
void tell_apart(const models::Scene& scene, const describe::PlaceGuide& guide,
                const std::vector<describe::PlaceGuide::Seen>& seen,
                std::vector<protocol::AroundPlace>& places) {
  const Vec3 middle = models::centre_m(scene);
  std::map<std::string, std::vector<std::size_t>> equal;
  for (std::size_t i = 0; i < places.size(); ++i) equal[places[i].words].push_back(i);
  for (const auto& [words, entries] : equal) {
    if (entries.size() < 2) continue;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const Place at = guide.places()[seen[entries[k]].place].name.at;
      places[entries[k]].words =
          describe::phrase("{}, {} of {}, {}", words, k + 1, entries.size(),
                           describe::from_middle_words({at.x_m - middle.x, at.y_m - middle.y}));
    }
  }
}

}  // namespace

const describe::PlaceGuide& PageNames::guide(const models::Scene& scene) {
  const bool is_of_scene = guide_ != nullptr && guide_->is_of(scene);
  if (is_of_scene && language_ == describe::current_language()) return *guide_;
  guide_ = std::make_unique<const describe::PlaceGuide>(scene);
  language_ = describe::current_language();
  // In another language the places are the same, in the same order.
  if (!is_of_scene) ++list_;
  return *guide_;
}

protocol::Around PageNames::around(const models::Scene& scene, const protocol::LookAround& question) {
  const describe::PlaceGuide& names = guide(scene);
  protocol::Around answer;
  answer.serial = question.serial;
  answer.list = list_;
  const Place from{question.x_m, question.y_m};
  const auto all = names.around(from);
  for (const auto& seen : all) {
    const describe::NamedPlace& place = names.places()[seen.place];
    answer.places.push_back({static_cast<std::int64_t>(seen.place), place.name.name,
                             fmt::format("{}, {}", place.words, describe::way_words(seen, from)),
                             place.name.sentence, place.written.has_value(), seen.distance_m == 0.0});
  }
  tell_apart(scene, names, all, answer.places);
  return answer;
}

Result<std::optional<std::size_t>> PageNames::place_in_list(const models::Scene& scene, std::int64_t list,
                                                            std::optional<std::int64_t> place) {
  const auto count = guide(scene).places().size();
  if (!place) return std::optional<std::size_t>();
  if (list != list_ || static_cast<std::size_t>(*place) >= count)
    return Error{ErrorCode::usage, describe::tr("the names have changed: list them anew"), {}};
  return std::optional(static_cast<std::size_t>(*place));
}

Result<describe::NamesEdit> PageNames::edited(const models::Scene& scene, const protocol::Name& name) {
  const auto place = place_in_list(scene, name.list, name.place);
  if (!place) return place.error();
  return history_.name(scene, guide(scene), {name.name, name.sentence, {name.x_m, name.y_m}, {}, {}}, *place);
}

Result<describe::NamesEdit> PageNames::edited(const models::Scene& scene, const protocol::Unname& name) {
  const auto place = place_in_list(scene, name.list, name.place);
  if (!place) return place.error();
  return history_.remove(scene, guide(scene), **place);
}

Result<describe::NamesEdit> PageNames::edited(const models::Scene& scene, const protocol::UndoName& undo) {
  return undo.redo ? history_.redo(scene) : history_.undo(scene);
}

Result<std::optional<describe::PlaceGuide::Seen>> PageNames::find(const models::Scene& scene,
                                                                  const protocol::Find& find) {
  auto& target = targets_.at(static_cast<std::size_t>(find.probe));
  target.reset();
  const auto place = place_in_list(scene, find.list, find.place);
  if (!place) return place.error();
  if (!*place) return std::optional<describe::PlaceGuide::Seen>();
  target = guide(scene).places()[**place].name;
  return std::optional(guide(scene).seen(**place, {find.x_m, find.y_m}));
}

std::optional<std::size_t> PageNames::target(const models::Scene& scene, std::size_t probe) {
  const auto& wanted = targets_.at(probe);
  if (!wanted) return std::nullopt;
  const auto& places = guide(scene).places();
  auto found = std::find_if(places.begin(), places.end(),
                            [&](const describe::NamedPlace& place) { return place.name == *wanted; });
  // What the program found has another name in another language.
  if (found == places.end())
    found = std::find_if(places.begin(), places.end(), [&](const describe::NamedPlace& place) {
      return !place.written && place.name.at == wanted->at && place.name.extent == wanted->extent;
    });
  if (found == places.end()) return std::nullopt;
  return static_cast<std::size_t>(found - places.begin());
}

std::optional<describe::PlaceGuide::Seen> PageNames::seen(const models::Scene& scene, std::size_t probe,
                                                          Place from) {
  const auto place = target(scene, probe);
  if (!place) return std::nullopt;
  const auto seen = guide(scene).seen(*place, from);
  return seen.distance_m > 0.0 ? std::optional(seen) : std::nullopt;
}

protocol::Words PageNames::way(const models::Scene& scene, const protocol::Ask& ask) {
  const auto probe = static_cast<std::size_t>(ask.probe);
  const Place from{ask.x_m, ask.y_m};
  protocol::Words words;
  words.serial = ask.serial;
  const auto place = target(scene, probe);
  if (!place) {
    targets_.at(probe).reset();
    return words;
  }
  const describe::NamedPlace& named = guide(scene).places()[*place];
  if (const auto way = seen(scene, probe, from)) {
    words.text =
        fmt::format("{}: {}.", describe::capitalised(named.name.name), describe::way_words(*way, from));
    words.x_m = way->at.x_m;
    words.y_m = way->at.y_m;
    return words;
  }
  words.text = describe::phrase("Here: {}.", named.words) + (named.name.sentence.empty() ? "" : " ") +
               named.name.sentence;
  return words;
}

}  // namespace palpable::page
