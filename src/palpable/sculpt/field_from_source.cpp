// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field_from_source.hpp"

#include "palpable/sculpt/field_branches.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

using models::DistanceField;
using models::FieldGrid;
using models::FieldTree;

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

double longest_side(const Box& box) {
  const Vec3 size = box.most_m - box.least_m;
  return std::max({size.x, size.y, size.z});
}

/// Root cells near a sixteenth of the longest side.
FieldGrid grid_around(const Box& bounds, double cell_m, int resolution) {
  FieldGrid grid;
  grid.cell_m = cell_m;
  while ((16 << grid.levels) < resolution && grid.levels < 8) ++grid.levels;
  const double longest_m = longest_side(bounds);
  const double margin_m = std::max(0.06 * longest_m, std::min(0.002, longest_m));
  const double root_m = cell_m * (1 << grid.levels);
  const Vec3 size = bounds.most_m - bounds.least_m;
  const auto roots = [&](double extent) {
    return std::max(1, static_cast<int>(std::ceil((extent + 2.0 * margin_m) / root_m - 1e-9)));
  };
  grid.roots = {roots(size.x), roots(size.y), roots(size.z)};
  grid.origin_m = 0.5 * (bounds.least_m + bounds.most_m) - 0.5 * grid.size_m();
  return grid;
}

/// At random places near the surface.
models::FieldErrors measured(const DistanceField& field, const DistanceSource& source,
                             const FitBounds& bounds, const Work& work) {
  constexpr int kTries = 400000;
  constexpr std::size_t kEnough = 20000;
  std::mt19937_64 random(work.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Vec3 size = field.grid().size_m();
  std::vector<double> errors;
  DistanceSource::Hint hint;
  for (int i = 0; i < kTries && errors.size() < kEnough; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p = field.grid().origin_m + Vec3{x * size.x, y * size.y, z * size.z};
    const double felt = field.sample(p).distance_m;
    if (!(felt <= bounds.outside_m && felt >= -bounds.inside_m)) continue;
    errors.push_back(std::abs(felt - source.at(p, hint).distance_m));
  }
  models::FieldErrors result;
  result.bound_m = bounds.bound_m;
  if (errors.empty()) return result;
  std::sort(errors.begin(), errors.end());
  result.p99_m = errors[errors.size() * 99 / 100];
  result.max_m = errors.back();
  return result;
}

FitBounds bounds_for(double longest_m, double cell_m, const FieldOptions& options) {
  FitBounds bounds;
  bounds.cell_m = cell_m;
  bounds.bound_m = options.max_error_m > 0.0 ? options.max_error_m : 1e-4 * longest_m;
  bounds.inside_m = std::max(options.inside_m, 0.03 * longest_m);
  bounds.outside_m = std::max(options.outside_m, 0.01 * longest_m);
  return bounds;
}

/// How far a place is from a box; 0 inside.
double distance_to(const Box& box, Vec3 p) {
  const Vec3 d{std::max({box.least_m.x - p.x, 0.0, p.x - box.most_m.x}),
               std::max({box.least_m.y - p.y, 0.0, p.y - box.most_m.y}),
               std::max({box.least_m.z - p.z, 0.0, p.z - box.most_m.z})};
  return norm(d);
}

}  // namespace

Result<double> finest_cell_m(const Box& bounds, const FieldOptions& options) {
  if (options.resolution < 16 || options.resolution > 4096)
    return usage("a field's resolution is 16 to 4096 cells along its longest side");
  if (!(options.max_error_m >= 0.0 && options.max_error_m <= 1.0))
    return usage("a field's greatest error is 0 to 1 m");
  const double longest_m = longest_side(bounds);
  if (!(longest_m > 0.0 && longest_m < 1e6)) return invalid_input("is a solid without a finite extent");
  const double cell_m = longest_m / options.resolution;
  if (cell_m < 1e-6 || cell_m > 1.0)
    return invalid_input("would need cells of " + std::to_string(cell_m) +
                         " m; they are 1e-6 to 1 m: give the scene another size or resolution");
  return cell_m;
}

Result<DistanceField> field_from_source(const DistanceSource& source, const FieldOptions& options,
                                        const Work& work) {
  const Box box = source.bounds();
  const auto cell_m = finest_cell_m(box, options);
  if (!cell_m) return cell_m.error();
  const double longest_m = longest_side(box);
  const FieldGrid grid = grid_around(box, *cell_m, options.resolution);
  const FitBounds bounds = bounds_for(longest_m, *cell_m, options);
  const auto branches = branches_of(
      source, grid, bounds, options, [](int) { return true; }, work);
  if (!branches) return branches.error();
  Joiner joiner;
  for (const Branch& branch : *branches) joiner.add(branch);
  FieldTree tree = joiner.take();
  auto field = DistanceField::from_tree(grid, tree, {});
  if (!field) return field.error();
  const models::FieldErrors errors = measured(*field, source, bounds, work);
  work.report(1.0, "sampling the distance");
  return DistanceField::from_tree(grid, std::move(tree), errors);
}

Result<FieldUpdate> updated_field(const DistanceField& field, const DistanceSource& source,
                                  const Box& changed, const FieldOptions& options, const Work& work) {
  const FieldGrid& grid = field.grid();
  const Box box = source.bounds();
  if (!field.contains(box.least_m) || !field.contains(box.most_m))
    return Error{
        ErrorCode::failed, "the changed solid reaches out of the field's box: build the field anew", {}};
  FitBounds bounds = bounds_for(options.resolution * grid.cell_m, grid.cell_m, options);
  bounds.bound_m = field.errors().bound_m;
  const int side = 1 << grid.levels;
  const double half_m = 0.5 * grid.cell_m * side, reach_m = std::sqrt(3.0) * half_m;
  // Where the old surface is nearer than anything that changed, in the whole cell, nothing changes. Fields
  // err a little, and the window looks half a finest cell beyond.
  const auto touched = [&](int i) {
    const Vec3 corner{1.0 * (i % grid.roots[0]), 1.0 * (i / grid.roots[0] % grid.roots[1]),
                      1.0 * (i / (grid.roots[0] * grid.roots[1]))};
    const Vec3 middle = grid.origin_m + 2.0 * half_m * corner + Vec3{half_m, half_m, half_m};
    const double here_m = std::abs(field.sample(middle).distance_m);
    return distance_to(changed, middle) - reach_m < here_m + reach_m + 2.0 * grid.cell_m;
  };
  const auto fresh = branches_of(source, grid, bounds, options, touched, work);
  if (!fresh) return fresh.error();
  Joiner joiner;
  FieldUpdate update{field, 0};
  for (std::size_t i = 0; i < fresh->size(); ++i) {
    const bool again = touched(static_cast<int>(i));
    joiner.add(again ? (*fresh)[i] : branch_of(field.tree(), i));
    update.root_cells += again ? 1 : 0;
  }
  auto next = DistanceField::from_tree(grid, joiner.take(), field.errors());
  if (!next) return next.error();
  update.field = std::move(*next);
  return update;
}

}  // namespace palpable::sculpt
