// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/make_words.hpp"

#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace palpable::page::shelf {
namespace {

/// One option of the command; without a name: none.
struct Setting {
  const char* option = "";
  const char* value = "";
};

/// The word of an option with its value, which no value can turn into another option.
std::string word_of(std::string_view option, std::string_view value) {
  return fmt::format("{}={}", option, value);
}

/// What the files may be said to be.
struct Choice {
  std::string_view name;
  std::array<Setting, 2> settings;
  /// Number of files; 0: any.
  std::size_t files;
  const char* count_sentence;
  /// Whether the scene is low: a relief, not a solid.
  bool low;
  /// Whether it may be made quickly first.
  bool quick;
};

constexpr const char* kKind = "--kind";
constexpr const char* kAs = "--as";
constexpr std::array kChoices{
    Choice{"decide", {}, 0, "", false, false},
    Choice{"pair",
           {{{kKind, "stereo"}}},
           2,
           "a pair is two photographs: the left one and the right one",
           true,
           true},
    Choice{"double", {{{kKind, "stereo"}}}, 1, "a pair in one picture is one file", true, true},
    Choice{"drawing", {{{kKind, "picture"}, {kAs, "contours"}}}, 1, "a drawing is one file", true, false},
    Choice{"map", {{{kKind, "picture"}, {kAs, "map"}}}, 1, "a map is one file", true, false},
    Choice{"depth", {{{kKind, "depth"}}}, 0, "", true, false},
    Choice{"model", {}, 1, "a model is one file", false, false}};

Result<void> add_choice(std::vector<std::string>& words, const char* option,
                        const std::optional<std::string>& value, std::span<const std::string_view> known) {
  if (!value) return {};
  if (std::find(known.begin(), known.end(), *value) == known.end())
    return Error{ErrorCode::usage, fmt::format("{} has no such choice", option), {}};
  words.push_back(word_of(option, *value));
  return {};
}

void add_number(std::vector<std::string>& words, const char* option, const std::optional<double>& value) {
  if (value) words.push_back(word_of(option, fmt::format("{:g}", *value)));
}

}  // namespace

Result<MakeWords> make_words(const protocol::Make& wanted, const std::vector<std::filesystem::path>& files) {
  const auto* const choice = std::find_if(kChoices.begin(), kChoices.end(),
                                          [&](const Choice& one) { return one.name == wanted.what; });
  if (choice == kChoices.end()) return Error{ErrorCode::usage, "there is no such kind of file", {}};
  if (files.empty()) return Error{ErrorCode::usage, "choose a file first", {}};
  if (choice->files != 0 && files.size() != choice->files)
    return Error{ErrorCode::usage, choice->count_sentence, {}};
  MakeWords made;
  auto& words = made.words;
  words.emplace_back("make");
  for (const auto& file : files) words.push_back(file.string());
  for (const auto& [option, value] : choice->settings)
    if (*option != '\0') words.push_back(word_of(option, value));
  if (const std::string title = plain_name(wanted.title.value_or("")); !title.empty())
    words.push_back(word_of("--title", title));
  const bool is_pair = files.size() == 2 && wanted.what == "decide";
  if (wanted.size_mm) {
    // In proportion to the default sizes: 100 x 100 x 15 mm, and 100 x 100 x 50 mm for solids.
    const double depth = *wanted.size_mm * (choice->low || is_pair ? 0.15 : 0.5);
    words.push_back(word_of("--size", fmt::format("{0:g}x{0:g}x{1:g}", *wanted.size_mm, depth)));
  }
  add_number(words, "--exaggerate", wanted.exaggerate);
  add_number(words, "--moved", wanted.moved_mm);
  constexpr std::array<std::string_view, 3> kGround{"keep", "flatten", "remove"};
  constexpr std::array<std::string_view, 2> kBackground{"keep", "remove"};
  if (auto added = add_choice(words, "--ground", wanted.ground, kGround); !added) return added.error();
  if (auto added = add_choice(words, "--background", wanted.background, kBackground); !added)
    return added.error();
  if (!choice->quick) return made;
  made.quick_words = words;
  made.quick_words.push_back(word_of("--method", "fast"));
  return made;
}

}  // namespace palpable::page::shelf
