// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/name_keys.hpp"

#include <cctype>
#include <cstddef>
#include <set>

namespace palpable::describe {
namespace {

/// The ASCII letters of a name as small letters, and its initials.
struct Letters {
  std::string all;
  std::string initials;
};

Letters letters_of(const std::string& name) {
  Letters letters;
  bool begins = true;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalpha(byte) != 0) {
      const char small = static_cast<char>(std::tolower(byte));
      letters.all += small;
      if (begins) letters.initials += small;
      begins = false;
    } else if (byte < 128) {
      begins = true;
    }
  }
  return letters;
}

/// The first free key: initials, then the first letter with each later one, then any.
std::string free_key(const Letters& letters, const std::set<std::string>& used) {
  std::vector<std::string> wishes;
  for (std::size_t k = 1; k < letters.initials.size(); ++k)
    wishes.push_back({letters.initials[0], letters.initials[k]});
  for (std::size_t k = 1; k < letters.all.size(); ++k) wishes.push_back({letters.all[0], letters.all[k]});
  if (!letters.all.empty())
    for (char c = 'a'; c <= 'z'; ++c) wishes.push_back({letters.all[0], c});
  for (char first = 'a'; first <= 'z'; ++first)
    for (char c = 'a'; c <= 'z'; ++c) wishes.push_back({first, c});
  for (const std::string& wish : wishes)
    if (!used.contains(wish)) return wish;
  return {};
}

}  // namespace

std::vector<std::string> name_keys(const std::vector<std::string>& names) {
  std::vector<std::string> keys;
  std::set<std::string> used;
  for (const std::string& name : names) {
    keys.push_back(free_key(letters_of(name), used));
    used.insert(keys.back());
  }
  return keys;
}

}  // namespace palpable::describe
