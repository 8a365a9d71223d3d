// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field_update.hpp"

#include "palpable/sculpt/field_branches.hpp"
#include "palpable/sculpt/triangle_tree.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
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
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const auto changed_within = [&](Vec3 from_origin_m, double radius_m) {
    return triangles.any_within(grid.origin_m + from_origin_m, radius_m, kNone);
  };
  Earlier earlier{field.tree(), {}, {}};
  // Where the changed triangles, old and new, are farther than the surface, the nearest place did not change.
  earlier.changed_at = [&](Vec3 from_origin_m, double distance_m) {
    return changed_within(from_origin_m, (1.0 + 2.0 * TriangleTree::kNearestSlack) * std::abs(distance_m));
  };
  // How much farther they are changes by at most 2 per metre; and the earlier field tells the earlier
  // distance as far as its own bounds allow (leaf_fit.cpp).
  earlier.is_far = [&](Vec3 centre_m, double half_m) {
    const double distance_m = std::abs(field.sample(grid.origin_m + centre_m).distance_m);
    const double error_m =
        grid.cell_m + 5.0 * bounds.bound_m + 10.0 * bounds.bound_m / bounds.outside_m * distance_m;
    return !changed_within(centre_m, distance_m + error_m + 2.0 * std::sqrt(3.0) * half_m);
  };
  const auto branches = branches_of(source, grid, bounds, options, &earlier, work);
  if (!branches) return branches.error();
  Joiner joiner(&field.tree());
  for (const Branch& branch : *branches) joiner.add(branch);
  return DistanceField::from_tree(grid, joiner.take(), field.errors());
}

}  // namespace palpable::sculpt
