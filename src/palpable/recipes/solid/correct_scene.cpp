// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/correct_scene.hpp"

#include "palpable/sculpt/correction/field_correction.hpp"
#include "palpable/sculpt/field/field_surface.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

/// The options that the field was built with; its resolution follows from its cells. Its margin is the rule's
/// or what was asked for, rounded up to whole root cells.
sculpt::FieldOptions options_of(const models::Field& field) {
  const Vec3 size = field.most_m - field.least_m;
  sculpt::FieldOptions options;
  const double cells = std::max({size.x, size.y, size.z}) / field.distance.cell_m();
  options.resolution = std::clamp(static_cast<int>(std::lround(cells)), 16, 4096);
  options.max_error_m = field.distance.errors().bound_m;
  const models::FieldGrid& grid = field.distance.grid();
  const double asked_m = field.margin_m() - 0.5 * grid.cell_m * (1 << grid.levels);
  if (asked_m > sculpt::field_margin_m({field.least_m, field.most_m}, 0.0)) options.margin_m = asked_m;
  return options;
}

}  // namespace

Result<CorrectedScene> correct_scene(const models::Scene& scene, Mesh measured,
                                     const sculpt::CorrectionOptions& options, const Work& work) {
  const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model);
  if (field == nullptr)
    return Error{ErrorCode::usage,
                 "only a field is corrected, and this scene is a " + models::kind_of(scene.model),
                 {}};
  for (Vec3& v : measured.vertices_m) v = (scene.scene_from_input * Point<models::InputFrame>{v}).v;
  const models::DistanceField& distance = (*field)->distance;
  constexpr double kSpacingInCells = 4.0;
  work.report(0.0, "finding the field's surface");
  auto mesh = sculpt::surface_of_field(distance, kSpacingInCells * distance.cell_m(), work);
  if (!mesh) return mesh.error();
  auto predicted = sculpt::predicted_surface(*std::move(mesh));
  if (!predicted) return predicted.error();
  auto after = sculpt::corrected_field({distance, *std::move(predicted)}, measured, options,
                                       options_of(**field), work);
  if (!after) return after.error();
  const sculpt::CorrectedSurface& surface = after->surface;
  CorrectedScene corrected;
  corrected.measured_samples =
      static_cast<std::size_t>(std::count(surface.measured.begin(), surface.measured.end(), true));
  corrected.moved_samples = surface.moved.size();
  if (corrected.measured_samples == 0)
    return Error{ErrorCode::failed,
                 fmt::format("nothing of the measured surface lies within {:g} mm of the field's surface",
                             1000.0 * options.reach_m),
                 {}};
  if (after->rebuilt)
    corrected.made.notes.emplace_back(
        "The corrected solid leaves the field's box, or earlier corrections have left too large an error "
        "deep "
        "inside: the whole field was sampled again.");
  const sculpt::Box box = sculpt::bounds_of(surface.adapted());
  auto whole = models::field_of(std::move(after->field), box.least_m, box.most_m);
  if (!whole) return whole.error();
  models::Scene next = scene;
  next.model = std::make_shared<const models::Field>(*std::move(whole));
  next.source.method += fmt::format(", corrected by a measured surface (reach {:g} mm, transition {:g} mm)",
                                    1000.0 * options.reach_m, 1000.0 * options.transition_m);
  corrected.made.scene = std::move(next);
  return corrected;
}

}  // namespace palpable::recipes
