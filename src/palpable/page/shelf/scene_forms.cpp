// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/scene_forms.hpp"

#include "palpable/page/shelf/scene_card.hpp"

#include <algorithm>
#include <array>

namespace palpable::page::shelf {
namespace {

struct Form {
  std::string_view name;
  std::string_view suffix;
  bool on_paper = false;
};

constexpr std::string_view kWords = "words", kPrint = "print", kModel = "model", kScene = "scene";
// The likeliest first.
constexpr std::array kForms{Form{"phone", ".html"},        Form{"swell", ".svg", true},
                            Form{"braille", ".brf", true}, Form{"pins", ".pbm"},
                            Form{kWords, ".txt"},          Form{kPrint, ".stl"},
                            Form{kModel, ".glb"},          Form{kScene, ".palp"}};

/// Of liblouis, for the languages of the pages that are not that of export's own.
struct BrailleTable {
  std::string_view language, name;
};
constexpr std::array kTables{BrailleTable{"de", "de-g1.ctb"}, BrailleTable{"es", "es-g1.ctb"}};

/// As `palpable export` has them.
bool fits(const Form& form, std::string_view kind) {
  if (form.name == kWords) return kind == kMapKind;
  if (form.name == kPrint || form.name == kModel) return kind != kGridKind;
  return true;
}

}  // namespace

std::vector<std::string> forms_of(std::string_view kind) {
  std::vector<std::string> names;
  for (const Form& form : kForms)
    if (fits(form, kind)) names.emplace_back(form.name);
  return names;
}

Result<SaveWords> save_words(const protocol::SaveAs& wanted, std::string_view kind) {
  const auto* const form =
      std::find_if(kForms.begin(), kForms.end(), [&](const Form& one) { return one.name == wanted.form; });
  if (form == kForms.end() || !fits(*form, kind))
    return Error{ErrorCode::usage, "this scene cannot be saved as that", {}};
  SaveWords words{std::string(form->suffix), {}, form->name == kScene};
  const auto* const table = std::find_if(kTables.begin(), kTables.end(), [&](const BrailleTable& one) {
    return one.language == wanted.language;
  });
  if (form->on_paper && table != kTables.end()) words.options = {"--braille-table", std::string(table->name)};
  if (!wanted.paper) return words;
  if (*wanted.paper != "A4" && *wanted.paper != "A3")
    return Error{ErrorCode::usage, "there is no such paper", {}};
  if (form->on_paper) words.options.insert(words.options.end(), {"--paper", *wanted.paper});
  return words;
}

}  // namespace palpable::page::shelf
