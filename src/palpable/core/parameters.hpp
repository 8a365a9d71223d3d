// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace palpable {

/// The values that a parameter may have, both ends included.
struct ParameterRange {
  double least = 0.0;
  double most = 0.0;
};

/// One number of an options struct, described: so that it can be listed, set by its name and checked. It
/// refers to the struct that it was made from, which must outlive it.
struct Parameter {
  /// The field's path in the struct: "search.hidden_cost".
  std::string name;
  std::variant<int*, float*, double*> value;
  ParameterRange range;
  /// "px", "levels" …; empty for a pure number.
  std::string unit;
  /// One phrase.
  std::string meaning;

  double get() const;
  bool is_whole() const { return std::holds_alternative<int*>(value); }
};

/// The parameters of a struct are listed by a function `parameters_of(Options&)` beside it. Those of a part
/// of it are added under the part's name.
void append_parameters(std::vector<Parameter>& to, std::string_view part, std::vector<Parameter> from);

/// Errors: usage, for a number outside the range or, where whole numbers are wanted, between two; nothing is
/// changed then. The error's place is the parameter's name.
Result<void> set_parameter(const Parameter& parameter, double value);

/// Errors: usage, for the first parameter outside its range (or NaN).
Result<void> check_parameters(std::span<const Parameter> parameters);

/// Whether every parameter of `options` lies in its range. Errors: as check_parameters().
template <class Options>
Result<void> check_ranges(Options options) {
  return check_parameters(parameters_of(options));
}

}  // namespace palpable
