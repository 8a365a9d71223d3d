// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/known_length.hpp"

#include "palpable/core/text/number_text.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> out;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.empty()) return out;
    out.push_back(text.substr(0, text.find(' ')));
    text.remove_prefix(out.back().size());
  }
}

std::optional<vision::ImagePoint> place_from(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto x = finite_number(word.substr(0, comma)), y = finite_number(word.substr(comma + 1));
  if (!x || !y) return std::nullopt;
  return vision::ImagePoint{*x, *y};
}

std::optional<double> metres_in(std::string_view unit) {
  if (unit == "mm") return 0.001;
  if (unit == "cm") return 0.01;
  return unit == "m" ? std::optional(1.0) : std::nullopt;
}

}  // namespace

Result<recipes::KnownLength> known_length_from(const std::string& text) {
  const Error wrong{
      ErrorCode::usage,
      fmt::format("'{}' is not a length: write it as '120 mm between 210,240 and 330,250 of frame 40'", text),
      "--length"};
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != 9 || words[2] != "between" || words[4] != "and" || words[6] != "of" ||
      words[7] != "frame")
    return wrong;
  const auto value = finite_number(words[0]), unit = metres_in(words[1]), frame = finite_number(words[8]);
  const auto from = place_from(words[3]), to = place_from(words[5]);
  constexpr double kMostFrames = 1e9;
  if (!value || !unit || !frame || !from || !to || !(*value > 0) || *frame < 0 || *frame > kMostFrames ||
      *frame != std::floor(*frame) || *from == *to)
    return wrong;
  return recipes::KnownLength{*value * *unit, static_cast<int>(*frame), *from, *to};
}

}  // namespace palpable::cli
