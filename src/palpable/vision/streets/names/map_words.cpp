// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/map_words.hpp"

#include "palpable/core/text/edit_distance.hpp"
#include "palpable/vision/streets/names/street_names.hpp"
#include "palpable/vision/text/compared_form.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace palpable::vision {
namespace {

std::string_view first_word(std::string_view words) { return words.substr(0, words.find(' ')); }
std::string_view last_word(std::string_view words) {
  const std::size_t at = words.rfind(' ');
  return at == words.npos ? words : words.substr(at + 1);
}
bool has_words(std::string_view words) { return words.find(' ') != words.npos; }

/// Words of a map: how they are compared, how they are written most often, and in how many names they are.
class CommonWords {
 public:
  void add(std::string_view word, const std::string& name) {
    Entry& entry = entries_[compared_form(word)];
    entry.names.insert(name);
    ++entry.spellings[std::string(word)];
  }
  /// Keeps those that at least `fewest` names have.
  void keep(int fewest) {
    std::erase_if(entries_, [&](const auto& entry) {
      return entry.first.empty() || static_cast<int>(entry.second.names.size()) < fewest;
    });
  }
  bool has(std::string_view word) const { return entries_.contains(compared_form(word)); }
  /// The only one that differs by one letter.
  std::optional<std::string> nearest(std::string_view word) const {
    const std::string form = compared_form(word);
    std::optional<std::string> out;
    for (const auto& [other, entry] : entries_) {
      if (edit_distance(form, other) != 1) continue;
      if (out) return std::nullopt;
      out = std::max_element(entry.spellings.begin(), entry.spellings.end(), [](auto& a, auto& b) {
              return a.second < b.second;
            })->first;
    }
    return out;
  }

 private:
  struct Entry {
    std::set<std::string> names;
    std::map<std::string, int> spellings;
  };
  std::map<std::string, Entry> entries_;
};

struct MapWords {
  CommonWords first, last, endings;
};

MapWords words_of(std::span<const ReadLine> read, const MapWordsOptions& options) {
  MapWords out;
  for (const ReadLine& line : read) {
    // Words whose first letters are cut off are none of the map's.
    if (line.confidence < options.least_confidence || !is_whole_name(line.text)) continue;
    const std::string name = compared_form(line.text);
    if (has_words(line.text)) {
      out.first.add(first_word(line.text), name);
      out.last.add(last_word(line.text), name);
    } else {
      for (auto n = static_cast<std::size_t>(options.least_ending); n + 1 < line.text.size(); ++n)
        out.endings.add(std::string_view(line.text).substr(line.text.size() - n), name);
    }
  }
  for (CommonWords* words : {&out.first, &out.last, &out.endings}) words->keep(options.fewest_names);
  return out;
}

/// A word without an ending of the map, with the one that its ending differs from by one letter.
std::string with_ending(const std::string& word, const CommonWords& endings, const MapWordsOptions& options) {
  std::optional<std::string> better;
  for (auto n = static_cast<std::size_t>(options.least_ending); n + 1 < word.size(); ++n) {
    const std::string ending = word.substr(word.size() - n);
    if (endings.has(ending)) return word;
    if (const auto like = endings.nearest(ending); like && like->size() == n)
      better = word.substr(0, word.size() - n) + *like;
  }
  return better.value_or(word);
}

/// A word that one of the map's differs from by one letter becomes that one; short words only if they lack a
/// letter ("ue").
std::string with_word(const std::string& word, const CommonWords& words) {
  constexpr std::size_t kShort = 2;
  if (words.has(word)) return word;
  const auto better = words.nearest(word);
  return better && (word.size() > kShort || better->size() > word.size()) ? *better : word;
}

std::string corrected(const std::string& text, const MapWords& words, const MapWordsOptions& options) {
  if (!has_words(text)) return with_ending(text, words.endings, options);
  const std::string first(first_word(text)), last(last_word(text));
  return with_word(first, words.first) + text.substr(first.size(), text.size() - first.size() - last.size()) +
         with_word(last, words.last);
}

}  // namespace

std::vector<Parameter> parameters_of(MapWordsOptions& o) {
  return {{"fewest_names", &o.fewest_names, {2, 100}, "", "names that have a word of the map"},
          {"least_confidence", &o.least_confidence, {0, 1}, "", "of these names"},
          {"least_ending", &o.least_ending, {2, 20}, "letters", "of endings"}};
}

void correct_by_map_words(std::span<ReadLine> read, const MapWordsOptions& options) {
  const MapWords words = words_of(read, options);
  for (ReadLine& line : read) {
    if (line.text.empty()) continue;
    std::string better = corrected(line.text, words, options);
    if (better == line.text) continue;
    line.text = std::move(better);
    line.others.push_back(line.text);
  }
}

}  // namespace palpable::vision
