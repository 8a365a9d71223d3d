// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/relative_text.hpp"

#include "palpable/core/text/number_text.hpp"
#include "palpable/sources/solid/text_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

/// The coordinates that follow the keyword, which are taken from the line; a fourth number alone would be a
/// weight. nullopt if they are not understood.
std::optional<Vec3> vertex_in(std::string_view& line) {
  std::array<double, 3> values{};
  for (double& value : values) {
    const auto number = finite_number(next_word(line));
    if (!number) return std::nullopt;
    value = *number;
  }
  std::string_view rest = line;
  int more = 0;
  while (!next_word(rest).empty()) ++more;
  if (more != 0 && more != 3 && more != 4) return std::nullopt;
  return Vec3{values[0], values[1], values[2]};
}

struct Extent {
  Vec3 least = {kLargest, kLargest, kLargest};
  Vec3 most = {-kLargest, -kLargest, -kLargest};

  void include(Vec3 v) {
    least = {std::min(least.x, v.x), std::min(least.y, v.y), std::min(least.z, v.z)};
    most = {std::max(most.x, v.x), std::max(most.y, v.y), std::max(most.z, v.z)};
  }

 private:
  static constexpr double kLargest = std::numeric_limits<double>::max();
};

/// nullopt if a vertex is not understood, or there is none.
std::optional<Extent> extent_of(std::string_view text, std::string_view keyword) {
  Extent extent;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    if (next_word(line) != keyword) continue;
    const auto vertex = vertex_in(line);
    if (!vertex) return std::nullopt;
    extent.include(*vertex);
  }
  if (extent.least.x > extent.most.x) return std::nullopt;
  return extent;
}

/// Whether single precision loses six of its 24 bits, or more, to the distance from the origin.
bool is_far(const Extent& extent) {
  constexpr double kTimes = 64.0;
  double farthest = 0.0;
  for (const Vec3& v : {extent.least, extent.most})
    farthest = std::max({farthest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return farthest > kTimes * norm(extent.most - extent.least);
}

}  // namespace

std::optional<RelativeText> relative_to_its_place(std::string_view text, std::string_view keyword) {
  const auto extent = extent_of(text, keyword);
  if (!extent || !is_far(*extent)) return std::nullopt;
  RelativeText out{{}, 0.5 * (extent->least + extent->most)};
  out.text.reserve(text.size());
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    std::string_view left = line;
    if (next_word(left) == keyword) {
      // Of every vertex it was found above that it is one.
      const Vec3 at = *vertex_in(left) - out.origin;
      fmt::format_to(std::back_inserter(out.text), "{} {:.9g} {:.9g} {:.9g}{}\n", keyword, at.x, at.y, at.z,
                     left);
    } else {
      out.text.append(line).push_back('\n');
    }
  }
  return out;
}

}  // namespace palpable::sources
