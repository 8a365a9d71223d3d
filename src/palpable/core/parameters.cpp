// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/parameters.hpp"

#include <cmath>
#include <sstream>
#include <type_traits>
#include <utility>

namespace palpable {
namespace {

std::string in_words(double value) {
  std::ostringstream words;
  words << value;
  return words.str();
}

Result<void> check_value(const Parameter& p, double value) {
  if (!(value >= p.range.least && value <= p.range.most))
    return Error{ErrorCode::usage,
                 "must lie between " + in_words(p.range.least) + " and " + in_words(p.range.most) +
                     (p.unit.empty() ? "" : " " + p.unit) + ", not " + in_words(value),
                 p.name};
  if (p.is_whole() && value != std::floor(value))
    return Error{ErrorCode::usage, "must be a whole number, not " + in_words(value), p.name};
  return {};
}

}  // namespace

double Parameter::get() const {
  return std::visit([](const auto* number) { return static_cast<double>(*number); }, value);
}

void append_parameters(std::vector<Parameter>& to, std::string_view part, std::vector<Parameter> from) {
  for (Parameter& p : from) {
    p.name = std::string(part) + "." + p.name;
    to.push_back(std::move(p));
  }
}

Result<void> set_parameter(const Parameter& parameter, double value) {
  if (const auto ok = check_value(parameter, value); !ok) return ok;
  std::visit([&](auto* number) { *number = static_cast<std::remove_reference_t<decltype(*number)>>(value); },
             parameter.value);
  return {};
}

Result<void> check_parameters(std::span<const Parameter> parameters) {
  for (const Parameter& p : parameters)
    if (const auto ok = check_value(p, p.get()); !ok) return ok;
  return {};
}

}  // namespace palpable
