// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/name_search.hpp"

#include "palpable/core/text/edit_distance.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

void add_once(std::vector<std::size_t>& found, std::size_t i, const std::vector<std::string>& names) {
  for (const std::size_t known : found)
    if (small_letters(names[known]) == small_letters(names[i])) return;
  found.push_back(i);
}

}  // namespace

std::string small_letters(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

MeantNames meant_names(const std::string& asked, const std::vector<std::string>& names) {
  const std::string wanted = small_letters(asked);
  MeantNames found;
  if (wanted.empty()) return found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = small_letters(names[i]);
    if (name == wanted) return {{i}, true};
    if (name.starts_with(wanted)) add_once(found.names, i, names);
  }
  if (!found.names.empty()) return found;
  // One letter in five may differ.
  std::size_t least = wanted.size() / 5;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t d = edit_distance(wanted, small_letters(names[i]));
    if (d > least) continue;
    if (d < least) found.names.clear();
    least = d;
    add_once(found.names, i, names);
  }
  return found;
}

std::vector<std::size_t> similar_names(const std::string& asked, const std::vector<std::string>& names) {
  const std::string wanted = small_letters(asked);
  std::vector<std::pair<std::size_t, std::size_t>> near;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = small_letters(names[i]);
    const std::size_t d = edit_distance(wanted, name);
    if (2 * d <= std::max(wanted.size(), name.size())) near.emplace_back(d, i);
  }
  std::sort(near.begin(), near.end());
  std::vector<std::size_t> found;
  for (const auto& [d, i] : near) add_once(found, i, names);
  return found;
}

std::string some_of(const std::vector<std::size_t>& which, const std::vector<std::string>& names) {
  std::vector<std::string> some;
  for (const std::size_t i : which) {
    if (some.size() == kMostNamesSaid) {
      some.push_back(phrase("{} more", which.size() - kMostNamesSaid));
      break;
    }
    some.push_back(names[i]);
  }
  return listed(some);
}

}  // namespace palpable::describe
