// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/make_arguments.hpp"
#include "palpable/recipes/solid/shapes_recipe.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <optional>
#include <string>

namespace palpable::cli {

/// The options for the session. Errors: usage, for an unknown kind, size or method.
Result<session::MakeOptions> make_options(const MakeArguments& arguments);

/// The options of fit-shapes: `shapes`, changed by --set. Errors: usage.
Result<sculpt::ShapeSetOptions> shape_options(const MakeArguments& arguments, sculpt::ShapeSetOptions shapes);

/// A wrong limit of the cache in the environment; nullopt if it is right, or with --no-cache.
std::optional<Note> note_on_cache(const MakeArguments& arguments);

/// How a solid that is wide and low, and is seen from the front, is seen from above; nullopt for others, and
/// where --lay was given.
std::optional<Note> note_on_lay(const MakeArguments& arguments, const session::MakeOptions& options,
                                const models::Scene& made);

/// A note on options and parameters that were given and have no effect on this scene (unused_options.hpp,
/// unused_parameters.hpp).
std::optional<Note> note_on_unused(const MakeArguments& arguments, const session::MakeOptions& options,
                                   const models::Scene& made);

/// Parses "WxHxD" in millimetres and returns metres; each 1 to 1000 mm. Errors: usage.
Result<Vec3> size_from(const std::string& text);

}  // namespace palpable::cli
