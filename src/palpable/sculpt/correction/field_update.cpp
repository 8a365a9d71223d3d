// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/field_update.hpp"

#include "palpable/sculpt/field/field_branches.hpp"
#include "palpable/sculpt/solid/blended_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace palpable::sculpt {
namespace {

using models::DistanceField;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Resampled {
  DistanceField field;
  /// From the source's hints (DistanceSource::Hint).
  double greatest_difference_m = 0.0;
};

/// The field with those cells of its tree sampled from `source` that `earlier` does not exclude.
Result<Resampled> resampled(const DistanceField& field, const DistanceSource& source, const Earlier& earlier,
                            const FitBounds& bounds, const FieldOptions& options, const Work& work) {
  const auto branches = branches_of(source, field.grid(), bounds, options, &earlier, work);
  if (!branches) return branches.error();
  Joiner joiner(&field.tree());
  double greatest_m = 0.0;
  for (const Branch& branch : *branches) {
    joiner.add(branch);
    greatest_m = std::max(greatest_m, branch.greatest_difference_m);
  }
  auto updated = DistanceField::from_tree(field.grid(), joiner.take(), field.errors());
  if (!updated) return updated.error();
  return Resampled{*std::move(updated), greatest_m};
}

/// Whether changed triangles, old or new, may be the nearest ones.
class ChangedTriangles {
 public:
  ChangedTriangles(const DistanceField& field, const SolidChange& change, const FitBounds& bounds)
      : field_(field), change_(change), bounds_(bounds), triangles_(change.triangles) {}

  /// If they are farther away than the surface, the nearest point did not change. A smooth surface bulges
  /// beyond its triangles by less than half a cell if their corners are a few cells apart.
  bool changed_at(Vec3 place_m, double distance_m) const {
    return within(place_m,
                  (1.0 + 2.0 * TriangleTree::kNearestSlack) * std::abs(distance_m) + 0.5 * field_.cell_m());
  }
  /// The difference of both distances changes by at most 2 per metre. The earlier field's distance is
  /// correct within its own bounds (leaf_fit.cpp), or within the error that an earlier blend may have left.
  bool is_far(Vec3 centre_m, double half_m) const {
    const double distance_m = std::abs(field_.sample({centre_m}).distance_m);
    const double error_m =
        field_.cell_m() + 5.0 * bounds_.bound_m + 10.0 * bounds_.bound_m / bounds_.outside_m * distance_m;
    return !within(centre_m, distance_m + error_m + change_.step_m + 2.0 * std::sqrt(3.0) * half_m);
  }

 private:
  bool within(Vec3 place_m, double radius_m) const { return triangles_.any_within(place_m, radius_m, kNone); }

  const DistanceField& field_;
  const SolidChange& change_;
  const FitBounds& bounds_;
  TriangleTree triangles_;
};

}  // namespace

Result<std::optional<DistanceField>> updated_field(const DistanceField& field, const DistanceSource& source,
                                                   const SolidChange& change, const FieldOptions& options,
                                                   const Work& work) {
  const Box box = source.bounds();
  if (!field.contains({box.least_m}) || !field.contains({box.most_m}))
    return Error{
        ErrorCode::failed, "the changed solid leaves the field's box: build the whole field again", {}};
  const models::FieldGrid& grid = field.grid();
  FitBounds bounds = bounds_for(options.resolution * grid.cell_m, grid.cell_m, options);
  bounds.bound_m = field.errors().bound_m;
  const ChangedTriangles nearest(field, change, bounds);
  Earlier earlier{field.tree(), {}, {}};
  if (!std::isfinite(change.within_m)) {
    earlier.changed_at = [&](Vec3 from_origin_m, double distance_m) {
      return nearest.changed_at(grid.origin_m + from_origin_m, distance_m);
    };
    earlier.is_far = [&](Vec3 centre_m, double half_m) {
      return nearest.is_far(grid.origin_m + centre_m, half_m);
    };
    auto updated = resampled(field, source, earlier, bounds, options, work);
    if (!updated) return updated.error();
    return std::optional(std::move(updated->field));
  }
  const TriangleTree around(change.around);
  const auto within = [&](Vec3 place_m, double radius_m) {
    return around.any_within(place_m, radius_m, kNone);
  };
  earlier.changed_at = [&](Vec3 from_origin_m, double distance_m) {
    const Vec3 place_m = grid.origin_m + from_origin_m;
    // More than the rounding of an edge: a quick test that decides most moved places.
    const double differs_m = std::abs(distance_m - field.sample({place_m}).distance_m);
    return differs_m > 0.5 * grid.cell_m ||
           (within(place_m, change.within_m) && nearest.changed_at(place_m, distance_m));
  };
  earlier.is_far = [&](Vec3 centre_m, double half_m) {
    const Vec3 place_m = grid.origin_m + centre_m;
    return !within(place_m, change.within_m + std::sqrt(3.0) * half_m) || nearest.is_far(place_m, half_m);
  };
  // The slope of phi is 1.5 / (within - inside). With a difference of at most half of that width the
  // distance still decreases inwards, with a slope of at least a quarter.
  const double most_m = std::max(0.0, change.within_m - 3.0 * change.step_m);
  const double inside_m = std::min(most_m, bounds.inside_m);
  const BlendedSource blended(
      source, field, around, change.within_m,
      {inside_m / change.within_m, std::min(most_m, bounds.outside_m) / change.within_m});
  auto updated = resampled(field, blended, earlier, bounds, options, work);
  if (!updated) return updated.error();
  if (updated->greatest_difference_m > 0.5 * (change.within_m - inside_m))
    return std::optional<DistanceField>();
  return std::optional(std::move(updated->field));
}

}  // namespace palpable::sculpt
