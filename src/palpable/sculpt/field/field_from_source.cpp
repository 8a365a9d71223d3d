// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/field_from_source.hpp"

#include "palpable/sculpt/field/field_branches.hpp"
#include "palpable/sculpt/field/measured_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

using models::DistanceField;
using models::FieldGrid;
using models::FieldTree;

constexpr double kLargestMargin_m = 0.05;

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

double longest_side(const Box& box) {
  const Vec3 size = box.most_m - box.least_m;
  return std::max({size.x, size.y, size.z});
}

/// Root cells near a sixteenth of the longest side.
FieldGrid grid_around(const Box& bounds, double cell_m, const FieldOptions& options) {
  FieldGrid grid;
  grid.cell_m = cell_m;
  while ((16 << grid.levels) < options.resolution && grid.levels < 8) ++grid.levels;
  const double margin_m = field_margin_m(bounds, options.margin_m);
  const double root_m = cell_m * (1 << grid.levels);
  const Vec3 size = bounds.most_m - bounds.least_m;
  const auto roots = [&](double extent) {
    return std::max(1, static_cast<int>(std::ceil((extent + 2.0 * margin_m) / root_m - 1e-9)));
  };
  grid.roots = {roots(size.x), roots(size.y), roots(size.z)};
  grid.origin_m = 0.5 * (bounds.least_m + bounds.most_m) - 0.5 * grid.size_m();
  return grid;
}

}  // namespace

std::vector<Parameter> parameters_of(FieldOptions& o) {
  return {
      {"resolution", &o.resolution, {16, 4096}, "cells", "finest cells along the longest side"},
      {"max_error_m",
       &o.max_error_m,
       {0.0, 1.0},
       "m",
       "error bound; 0 = a ten-thousandth of the longest side"},
      {"inside_m", &o.inside_m, {0.0, 1.0}, "m", "how deep inside the bound holds"},
      {"outside_m", &o.outside_m, {0.0, 1.0}, "m", "how far outside the bound holds"},
      {"margin_m",
       &o.margin_m,
       {0.0, kLargestMargin_m},
       "m",
       "space around the solid, the largest radius of a ball that touches it; 0 = 6 % of the longest side, "
       "at least 2 mm"}};
}

double field_margin_m(const Box& bounds, double asked_m) {
  if (asked_m > 0.0) return asked_m;
  const double longest_m = longest_side(bounds);
  return std::max(0.06 * longest_m, std::min(0.002, 0.1 * longest_m));
}

Result<double> finest_cell_m(const Box& bounds, const FieldOptions& options) {
  if (options.resolution < 16 || options.resolution > 4096)
    return usage("a field's resolution is 16 to 4096 cells along its longest side");
  if (!(options.max_error_m >= 0.0 && options.max_error_m <= 1.0))
    return usage("a field's greatest error is 0 to 1 m");
  if (!(options.margin_m >= 0.0 && options.margin_m <= kLargestMargin_m))
    return usage("a field's margin is 0 to 0.05 m");
  const double longest_m = longest_side(bounds);
  if (!(longest_m > 0.0 && longest_m < 1e6)) return invalid_input("is a solid without a finite extent");
  const double cell_m = longest_m / options.resolution;
  if (cell_m < 1e-6 || cell_m > 1.0)
    return invalid_input("would need cells of " + std::to_string(cell_m) +
                         " m; they are 1e-6 to 1 m: give the scene another size or resolution");
  return cell_m;
}

double facet_rounding_m(const Box& bounds, const FieldOptions& options) {
  const auto cell_m = finest_cell_m(bounds, options);
  if (!cell_m) return 0.0;
  return std::min(kKinkInCells * *cell_m, 2.0 * bounds_for(longest_side(bounds), *cell_m, options).bound_m);
}

Result<DistanceField> field_from_source(const DistanceSource& source, const FieldOptions& options,
                                        const Work& work) {
  const Box box = source.bounds();
  const auto cell_m = finest_cell_m(box, options);
  if (!cell_m) return cell_m.error();
  const double longest_m = longest_side(box);
  const FieldGrid grid = grid_around(box, *cell_m, options);
  const FitBounds bounds = bounds_for(longest_m, *cell_m, options);
  auto branches = branches_of(source, grid, bounds, options, nullptr, work);
  if (!branches) return branches.error();
  Joiner joiner;
  // Freed one by one, since together they take more memory than the tree.
  for (Branch& branch : *branches) {
    joiner.add(branch);
    branch = {};
  }
  FieldTree tree = joiner.take();
  auto field = DistanceField::from_tree(grid, tree, {});
  if (!field) return field.error();
  models::FieldErrors errors = measured_errors([&](Vec3 p) { return field->sample({p}).distance_m; },
                                               {grid.origin_m, grid.origin_m + grid.size_m()}, source,
                                               {bounds.inside_m, bounds.outside_m}, work);
  errors.bound_m = bounds.bound_m;
  work.report(1.0, "sampling the distance");
  return DistanceField::from_tree(grid, std::move(tree), errors);
}

}  // namespace palpable::sculpt
