// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field_update.hpp"

#include "palpable/sculpt/field_branches.hpp"
#include "palpable/sculpt/triangle_tree.hpp"

#include <cmath>
#include <utility>

namespace palpable::sculpt {

using models::DistanceField;

Result<DistanceField> updated_field(const DistanceField& field, const DistanceSource& source,
                                    const Mesh& changed, const FieldOptions& options, const Work& work) {
  const Box box = source.bounds();
  if (!field.contains(box.least_m) || !field.contains(box.most_m))
    return Error{
        ErrorCode::failed, "the changed solid reaches out of the field's box: build the field anew", {}};
  const models::FieldGrid& grid = field.grid();
  FitBounds bounds = bounds_for(options.resolution * grid.cell_m, grid.cell_m, options);
  bounds.bound_m = field.errors().bound_m;
  const TriangleTree triangles(changed);
  // How much farther the changed triangles are than the surface, old or new: where it is above 0, the nearest
  // place did not change. Changes by at most 2 per metre.
  const auto farther_m = [&](Vec3 from_origin_m, double distance_m) {
    const double nearest_m =
        std::sqrt(triangles.nearest(grid.origin_m + from_origin_m, 0).squared_distance_m2);
    return nearest_m - (1.0 + 2.0 * TriangleTree::kNearestSlack) * std::abs(distance_m);
  };
  Earlier earlier{field.tree(), {}, {}};
  earlier.is_far = [&](Vec3 centre_m, double half_m, double distance_m) {
    return farther_m(centre_m, distance_m) > 2.0 * std::sqrt(3.0) * half_m;
  };
  earlier.change = [&](const CellSamples& samples) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < kFitPlaces; ++k)
      count += farther_m(samples.centre_m + samples.half_m * fit_place(k), samples.at[k].distance_m) <= 0.0;
    return count == 0 ? Change::none : count == kFitPlaces ? Change::all : Change::partly;
  };
  const auto branches = branches_of(source, grid, bounds, options, &earlier, work);
  if (!branches) return branches.error();
  Joiner joiner;
  for (const Branch& branch : *branches) joiner.add(branch);
  return DistanceField::from_tree(grid, joiner.take(), field.errors());
}

}  // namespace palpable::sculpt
