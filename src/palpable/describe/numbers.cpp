// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/numbers.hpp"

#include "palpable/describe/language.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

/// The value as the text shows it: "1" takes the singular.
std::string with_unit(const std::string& number, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", number, number == "1" || number == phrase("minus {}", "1") ? singular : plural);
}

std::string spoken(double value, int digits) {
  const std::string number = with_own_point(figure(value, digits));
  return number.starts_with('-') ? phrase("minus {}", number.substr(1)) : number;
}

}  // namespace

std::string length(double metres) {
  return std::abs(metres) < 0.9995 ? figure(1e3 * metres) + " mm" : figure(metres, 3) + " m";
}

std::string spoken_length(double metres) {
  if (!(std::abs(metres) < 0.9995)) return with_unit(spoken(metres, 3), tr("metre"), tr("metres"));
  const double mm = 1e3 * metres;
  const double rounded = std::abs(mm) < 9.95 ? std::round(10.0 * mm) / 10.0 : std::round(mm);
  return with_unit(spoken(rounded, 2), tr("millimetre"), tr("millimetres"));
}

std::string spoken_lengths(double first_m, std::string_view between, double second_m) {
  std::string first = spoken_length(first_m);
  const std::string second = spoken_length(second_m), unit = std::string(" ") + tr("millimetres");
  if (first.ends_with(unit) && second.ends_with(unit)) first.erase(first.rfind(' '));
  if (first == std::string("1 ") + tr("millimetre") && second.ends_with(unit)) first = "1";
  return fmt::format("{} {} {}", first, known(std::string(between)), second);
}

std::string spoken_force(double newtons) {
  return with_unit(spoken(newtons, 2), tr("newton"), tr("newtons"));
}

std::string spoken_angle(double radians) {
  return with_unit(figure(std::round(std::abs(radians) * 180.0 / std::numbers::pi), 3), tr("degree"),
                   tr("degrees"));
}

std::string counted(std::size_t count, std::string_view singular, std::string_view plural) {
  if (count == 0) return phrase("no {}", known(std::string(plural)));
  return fmt::format("{} {}", count, known(std::string(count == 1 ? singular : plural)));
}

std::string listed(std::span<const std::string> words) {
  if (words.empty()) return {};
  std::string text = words.front();
  for (std::size_t k = 1; k < words.size(); ++k)
    text += (k + 1 < words.size() ? std::string(", ") : fmt::format(" {} ", tr("and"))) + words[k];
  return text;
}

std::string capitalised(std::string sentence) {
  if (!sentence.empty() && sentence.front() >= 'a' && sentence.front() <= 'z')
    sentence.front() = static_cast<char>(sentence.front() - 'a' + 'A');
  // Letters of Latin-1 in UTF-8, as in "ü" and "á": without ÷ and ÿ.
  const auto second = sentence.size() > 1 ? static_cast<unsigned char>(sentence[1]) : 0U;
  if (sentence.starts_with('\xC3') && second >= 0xA0 && second <= 0xBE && second != 0xB7)
    sentence[1] = static_cast<char>(second - 0x20);
  return sentence;
}

}  // namespace palpable::describe
