// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/formats/scene/superquadric_json.hpp"
#include "palpable/formats/scene/vec3_json.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

namespace palpable::formats {

/// Writes a solid's bounding box and the primitives that it was sampled from into its description.
template <class Distance>
void describe_solid(const models::SolidField<Distance>& field, nlohmann::json& description) {
  description["least_m"] = json_of(field.least_m);
  description["most_m"] = json_of(field.most_m);
  for (const models::Superquadric& shape : field.primitives)
    description["primitives"].push_back(json_of(shape));
}

/// The model of a solid from its distance field (adaptive or dense) and the bounding box and primitives in
/// its description. May throw nlohmann::json::exception (see model_codec.hpp).
template <class Distance>
Result<models::Model> model_from(Distance distance, const nlohmann::json& description) {
  auto field = models::field_of(std::move(distance), vec3_from(description.at("least_m")),
                                vec3_from(description.at("most_m")));
  if (!field) return field.error();
  if (description.contains("primitives")) {
    auto primitives = superquadrics_from(description);
    if (!primitives) return primitives.error();
    field->primitives = *std::move(primitives);
  }
  return models::Model(std::make_shared<const models::SolidField<Distance>>(*std::move(field)));
}

}  // namespace palpable::formats
