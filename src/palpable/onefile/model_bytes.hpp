// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/onefile/byte_archive.hpp"

namespace palpable::onefile {

/// Writes a model of any kind, so that the same model can be made from it.
void write_model(ByteOutput& out, const models::Model& model);

/// Makes the model. Errors: invalid_input for bytes that are damaged or cut off, and for values that no model
/// of that kind can have.
Result<models::Model> read_model(ByteInput& in);

}  // namespace palpable::onefile
