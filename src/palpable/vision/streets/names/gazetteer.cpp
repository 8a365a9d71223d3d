// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/gazetteer.hpp"

#include "palpable/core/text/edit_distance.hpp"

#include <algorithm>

namespace palpable::vision {

Result<std::vector<std::string>> parse_gazetteer(std::string_view text) {
  std::vector<std::string> names;
  while (!text.empty() && names.size() <= kMaxNames) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty() && line.size() <= kMaxNameBytes) names.emplace_back(line);
  }
  if (names.empty() || names.size() > kMaxNames)
    return invalid_input("is no gazetteer: a text file with one name a line, 1 to 1 000 000 of them");
  return names;
}

double similarity_of(std::string_view a, std::string_view b) {
  const std::size_t longer = std::max(a.size(), b.size());
  if (longer == 0) return 0.0;
  return 1.0 - static_cast<double>(edit_distance(a, b)) / static_cast<double>(longer);
}

std::optional<std::string> nearest_name(std::string_view read, std::span<const std::string> gazetteer,
                                        double least) {
  const std::string wanted = compared_form(read);
  std::optional<std::string> best;
  for (const std::string& name : gazetteer) {
    const std::string form = compared_form(name);
    // The difference of lengths alone may be too large.
    const auto longer = static_cast<double>(std::max(form.size(), wanted.size()));
    const auto shorter = static_cast<double>(std::min(form.size(), wanted.size()));
    if (shorter < least * longer) continue;
    const double similarity = similarity_of(form, wanted);
    if (similarity < least || (best && similarity == least)) continue;
    least = similarity;
    best = name;
  }
  return best;
}

}  // namespace palpable::vision
