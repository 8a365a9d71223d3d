// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/scene/scene.hpp"

#include <algorithm>

namespace palpable::models {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
// clang 14, which builds the fuzzers, does not deduce this by itself.
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

std::string kind_of(const Model& model) {
  return std::visit(
      Overloaded{[](const std::shared_ptr<const Relief>&) { return std::string("relief"); },
                 [](const std::shared_ptr<const Contours>&) { return std::string("contours"); },
                 [](const std::shared_ptr<const Field>&) { return std::string("field"); },
                 [](const std::shared_ptr<const Grid>&) { return std::string("grid"); },
                 [](const std::shared_ptr<const FieldOnLattice>&) { return std::string("dense-field"); }},
      model);
}

bool is_field(const Model& model) noexcept {
  return std::holds_alternative<std::shared_ptr<const Field>>(model) ||
         std::holds_alternative<std::shared_ptr<const FieldOnLattice>>(model);
}

std::size_t label_at(const Scene& scene, Point<SceneFrame> place) {
  if (scene.labels.empty() || !is_finite(place)) return 0;
  const Vec3 size = size_m(scene);
  const auto cell = [](double position, double extent, int count) {
    return static_cast<int>(std::clamp((position / extent + 0.5) * count, 0.0, count - 1.0));
  };
  const std::uint8_t label = scene.labels(cell(place.v.x, size.x, scene.labels.width()),
                                          cell(-place.v.y, size.y, scene.labels.height()));
  return std::min<std::size_t>(label, scene.materials.size() - 1);
}

const std::shared_ptr<const Relief>& relief_of(const Scene& scene) {
  if (const auto* contours = std::get_if<std::shared_ptr<const Contours>>(&scene.model))
    return (*contours)->grooves;
  if (const auto* field = std::get_if<std::shared_ptr<const Field>>(&scene.model))
    return (*field)->from_above;
  if (const auto* grid = std::get_if<std::shared_ptr<const Grid>>(&scene.model)) return (*grid)->from_above;
  if (const auto* dense = std::get_if<std::shared_ptr<const FieldOnLattice>>(&scene.model))
    return (*dense)->from_above;
  return std::get<std::shared_ptr<const Relief>>(scene.model);
}

bool has_model(const Scene& scene) noexcept {
  return std::visit([](const auto& model) { return model != nullptr; }, scene.model);
}

Vec3 size_m(const Scene& scene) {
  return std::visit(
      Overloaded{
          [](const std::shared_ptr<const Relief>& relief) {
            return Vec3{relief->size_x_m(), relief->size_y_m(), relief->highest_m()};
          },
          [](const std::shared_ptr<const Contours>& contours) {
            return Vec3{contours->boundaries.size_x_m(), contours->boundaries.size_y_m(),
                        contours->grooves->highest_m()};
          },
          [](const std::shared_ptr<const Field>& field) { return field->most_m - field->least_m; },
          [](const std::shared_ptr<const FieldOnLattice>& field) { return field->most_m - field->least_m; },
          [](const std::shared_ptr<const Grid>& grid) {
            return Vec3{grid->from_above->size_x_m(), grid->from_above->size_y_m(),
                        grid->from_above->highest_m()};
          }},
      scene.model);
}

bool is_upright_solid(const Scene& scene) noexcept {
  return is_field(scene.model) && scene.pose == SolidPose::upright;
}

Vec3 centre_m(const Scene& scene) {
  if (const auto* field = std::get_if<std::shared_ptr<const Field>>(&scene.model))
    return 0.5 * ((*field)->least_m + (*field)->most_m);
  if (const auto* dense = std::get_if<std::shared_ptr<const FieldOnLattice>>(&scene.model))
    return 0.5 * ((*dense)->least_m + (*dense)->most_m);
  return {0.0, 0.0, 0.5 * size_m(scene).z};
}

}  // namespace palpable::models
