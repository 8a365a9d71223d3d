// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/key_names.hpp"

#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {

std::shared_ptr<const models::Scene> KeyNames::named(const std::shared_ptr<const models::Scene>& touched) {
  if (!edited_) {
    touched_names_ = touched->names;
    return touched;
  }
  if (touched != touched_ || named_ == nullptr) {
    auto named = std::make_shared<models::Scene>(*touched);
    named->names = *edited_;
    touched_ = touched;
    named_ = std::move(named);
  }
  return named_;
}

const describe::PlaceGuide& KeyNames::guide(const models::Scene& scene) {
  if (guide_ == nullptr || !guide_->is_of(scene))
    guide_ = std::make_unique<const describe::PlaceGuide>(scene);
  return *guide_;
}

std::string KeyNames::taken(const models::Scene& scene, Result<describe::NamesEdit> edit) {
  if (!edit) return describe::capitalised(edit.error().message) + ".";
  edited_ = std::move(edit->names);
  named_.reset();
  if (touched_names_ && *touched_names_ == *edited_) {
    unsaved_.discard();
    return edit->words;
  }
  models::Scene named = scene;
  named.names = *edited_;
  if (const auto kept = unsaved_.keep(named); !kept)
    return fmt::format("{} It is lost at the end unless you save: {}.", edit->words, kept.error().sentence());
  return edit->words;
}

std::string KeyNames::list(const models::Scene& scene, Place from) {
  const describe::PlaceGuide& names = guide(scene);
  if (names.places().empty()) return "Nothing here has a name.";
  std::string lines = describe::counted(names.places().size(), "name", "names") + ", the nearest first:";
  for (const auto& seen : names.around(from))
    lines += fmt::format("\n{}, {}", names.places()[seen.place].words, describe::way_words(seen, from));
  return describe::capitalised(std::move(lines));
}

std::string KeyNames::name(const models::Scene& scene, Place at, std::string_view line) {
  if (line.empty()) return "Nothing is named.";
  const std::size_t colon = line.find(": ");
  models::PlaceName given{std::string(line.substr(0, colon)), {}, at};
  if (colon != std::string_view::npos) given.sentence = line.substr(colon + 2);
  return taken(scene, history_.name(scene, guide(scene), std::move(given)));
}

std::string KeyNames::find(const models::Scene& scene, Place from, std::string_view line) {
  target_.reset();
  if (line.empty()) return "Nothing is looked for.";
  const auto place = guide(scene).find(line, from);
  if (!place) return describe::capitalised(place.error().message) + ".";
  target_ = guide(scene).places()[*place].name;
  return way(scene, from);
}

std::string KeyNames::way(const models::Scene& scene, Place from) {
  if (!target_) return {};
  const auto& places = guide(scene).places();
  const auto place = std::find_if(places.begin(), places.end(),
                                  [&](const describe::NamedPlace& one) { return one.name == *target_; });
  if (place == places.end()) {
    target_.reset();
    return {};
  }
  const auto seen = guide(scene).seen(static_cast<std::size_t>(place - places.begin()), from);
  if (seen.distance_m > 0.0)
    return fmt::format("{}: {}.", describe::capitalised(place->name.name), describe::way_words(seen, from));
  target_.reset();
  return fmt::format("Here: {}.{}{}", place->words, place->name.sentence.empty() ? "" : " ",
                     place->name.sentence);
}

std::string KeyNames::undo(const models::Scene& scene) { return taken(scene, history_.undo(scene)); }

std::string KeyNames::save(const models::Scene& scene) {
  if (const auto saved = unsaved_.save(scene); !saved) return saved.error().sentence() + ".";
  touched_names_ = scene.names;
  return "The scene is saved as " + unsaved_.save_as().string() + ".";
}

std::string KeyNames::left_over_words() const {
  const auto file = formats::UnsavedScene::of_earlier_touch(unsaved_.save_as());
  return file.empty() ? "" : "Names of an earlier touch that were not saved are in " + file.string() + ".";
}

std::string KeyNames::unsaved_words() const {
  return unsaved_.file().empty()
             ? ""
             : "The names that you did not save are kept in " + unsaved_.file().string() + ".";
}

Result<void> KeyNames::none_lost() const {
  if (!edited_ || edited_ == touched_names_ || !unsaved_.file().empty()) return {};
  return Error{ErrorCode::failed, "the names that were given could be neither saved nor kept and are lost",
               unsaved_.save_as().string()};
}

}  // namespace palpable::cli
