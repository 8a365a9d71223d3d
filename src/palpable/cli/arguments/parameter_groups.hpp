// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/recipes/solid/shapes_recipe.hpp"
#include "palpable/session/make/make_scene.hpp"
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::cli {

/// All options whose parameters --set can change, except those of the stereo methods.
struct SettableOptions {
  session::Recipes recipes;
  sculpt::ShapeSetOptions shapes;
  vision::FitThresholds verdict;
};

/// The parameters of one processing step.
struct ParameterGroup {
  /// Prefix of their names: "contours" in "contours.standard.half_contrast".
  std::string_view name;
  std::string_view summary;
  /// The data on which the defaults were chosen; empty: they are initial values, not tuned.
  std::string_view tuned_on;
  std::vector<Parameter> (*parameters)(SettableOptions&);
};

/// All groups; a new one is added to this table.
std::span<const ParameterGroup> parameter_groups();

/// The group with this name; null if there is none.
const ParameterGroup* find_group(std::string_view name);

/// The group's parameters with their full names; they refer to `options`.
std::vector<Parameter> parameters_of(const ParameterGroup& group, SettableOptions& options);

/// Sets each NAME=VALUE of `given` among the `known` parameters. `owner` completes "palpable methods …",
/// which lists them. Errors: usage, for an unknown name (with the nearest known one), a value that is no
/// number, or one out of its range.
Result<void> set_parameters(std::span<const std::string> given, std::span<const Parameter> known,
                            std::string_view owner);

}  // namespace palpable::cli
