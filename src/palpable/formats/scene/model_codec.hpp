// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/models/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

namespace palpable::formats {

// The codecs for each kind of model in a scene file: one source file per kind (relief_codec.cpp …), listed in
// scene_file.cpp's table. write_ puts the model's numbers into `description` ("model" in scene.json) and its
// large blocks into `members`. read_ validates everything. It may throw nlohmann::json::exception for a
// description of another shape, which scene_file.cpp turns into an Error. Errors: failed on writing,
// invalid_input on reading.

Result<void> write_relief(const models::Relief& relief, nlohmann::json& description, ZipMembers& members);
Result<models::Model> read_relief(const nlohmann::json& description, const ZipMembers& members);

Result<void> write_grid(const models::Grid& grid, nlohmann::json& description, ZipMembers& members);
Result<models::Model> read_grid(const nlohmann::json& description, const ZipMembers& members);

Result<void> write_contours(const models::Contours& contours, nlohmann::json& description,
                            ZipMembers& members);
Result<models::Model> read_contours(const nlohmann::json& description, const ZipMembers& members);

Result<void> write_field(const models::Field& field, nlohmann::json& description, ZipMembers& members);
Result<models::Model> read_field(const nlohmann::json& description, const ZipMembers& members);

Result<void> write_dense_field(const models::FieldOnLattice& field, nlohmann::json& description,
                               ZipMembers& members);
Result<models::Model> read_dense_field(const nlohmann::json& description, const ZipMembers& members);

}  // namespace palpable::formats
