// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/language.hpp"

#include "palpable/describe/catalogues.gen.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>

#include <nlohmann/json.hpp>

namespace palpable::describe {
namespace {

using Catalogue = std::unordered_map<std::string, std::string>;

Catalogue read(std::string_view json) {
  return nlohmann::json::parse(json).get<std::unordered_map<std::string, std::string>>();
}

const Catalogue* catalogue_of(Language language) {
  static const Catalogue german = read(kGermanCatalogue), spanish = read(kSpanishCatalogue);
  if (language == Language::german) return &german;
  return language == Language::spanish ? &spanish : nullptr;
}

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): LanguageScope alone changes it.
thread_local Language spoken = Language::english;

}  // namespace

std::optional<Language> language_from(std::string_view code) {
  if (code == "en") return Language::english;
  if (code == "de") return Language::german;
  return code == "es" ? std::optional(Language::spanish) : std::nullopt;
}

LanguageScope::LanguageScope(Language language) : before_(spoken) { spoken = language; }
LanguageScope::~LanguageScope() { spoken = before_; }

Language current_language() { return spoken; }

const char* tr(const char* english) {
  const Catalogue* const catalogue = catalogue_of(spoken);
  if (catalogue == nullptr) return english;
  const auto found = catalogue->find(english);
  return found == catalogue->end() ? english : found->second.c_str();
}

std::string known(const std::string& text) { return tr(text.c_str()); }

std::string with_own_point(std::string figure) {
  if (spoken != Language::english) std::replace(figure.begin(), figure.end(), '.', ',');
  return figure;
}

}  // namespace palpable::describe
