// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

// The language in which sentences are made (docs/adr/0013). A message is identified by its English text, with
// fmt's {} or {0} for its arguments; web/languages/program/*.json hold the others.

namespace palpable::describe {

enum class Language { english, german, spanish };

/// The language of a code of ISO 639-1: "en", "de", "es".
std::optional<Language> language_from(std::string_view code);

/// Until its end, this thread makes sentences in a language. Without one they are in English. Scopes nest.
class LanguageScope {
 public:
  explicit LanguageScope(Language language);
  LanguageScope(const LanguageScope&) = delete;
  LanguageScope& operator=(const LanguageScope&) = delete;
  ~LanguageScope();

 private:
  Language before_;
};

Language current_language();

/// A message in the current language; the English text where the catalogue has no other. The result lives as
/// long as the program, or as the argument.
const char* tr(const char* english);
/// The same for a text that may be a message, as a name that the program gave.
std::string known(const std::string& text);

/// A message with its arguments.
template <class... Values>
std::string phrase(const char* english, const Values&... values) {
  return fmt::vformat(tr(english), fmt::make_format_args(values...));
}

/// The number 12.5 as the current language writes it: "12.5", "12,5".
std::string with_own_point(std::string figure);

}  // namespace palpable::describe
