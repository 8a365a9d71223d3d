// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/solid/solid.hpp"

#include <string>

namespace palpable::recipes {

/// The solid with the surface that the recipe asks for (SolidSurface), with a note on its errors. A solid
/// that already consists of superquadrics stays as it is. Long work. Errors: as predicted_solid() and
/// enclose().
Result<Solid> with_surface(Solid solid, FieldRecipe recipe, const Work& work);

/// The surface in words, to follow the name of an input; empty for the given one.
std::string words_of(SolidSurface surface);

}  // namespace palpable::recipes
