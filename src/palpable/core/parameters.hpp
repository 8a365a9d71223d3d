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

/// The range of a parameter, both ends included.
struct ParameterRange {
  double least = 0.0;
  double most = 0.0;
};

/// Describes one number of an options struct, so that it can be listed, set by name and checked. It refers to
/// the struct from which it was made, which must outlive it.
struct Parameter {
  /// The path of the field in the struct: "search.hidden_cost".
  std::string name;
  std::variant<int*, float*, double*> value;
  ParameterRange range;
  /// "px", "levels" …; empty for a pure number.
  std::string unit;
  /// What the parameter does, as one phrase.
  std::string meaning;

  double get() const;
  bool is_whole() const { return std::holds_alternative<int*>(value); }
};

/// Appends the parameters of a part of an options struct, with the part's name as prefix. Each options struct
/// has a function `parameters_of(Options&)` beside it that lists its parameters.
void append_parameters(std::vector<Parameter>& to, std::string_view part, std::vector<Parameter> from);

/// Sets a parameter. Errors: usage for a value outside the range, or a fraction where an integer is required;
/// nothing is changed then. The error's place is the parameter's name.
Result<void> set_parameter(const Parameter& parameter, double value);

/// Checks that all parameters are in range. Errors: usage for the first one that is not (or is NaN).
Result<void> check_parameters(std::span<const Parameter> parameters);

/// Whether every parameter of `options` lies in its range. Errors: as check_parameters().
template <class Options>
Result<void> check_ranges(Options options) {
  return check_parameters(parameters_of(options));
}

}  // namespace palpable
