// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/make_options.hpp"
#include "palpable/cli/arguments/material_options.hpp"
#include "palpable/cli/arguments/title_options.hpp"

namespace palpable::cli {

/// All command-line arguments for making a scene.
struct SceneArguments {
  MakeArguments make;
  MaterialArguments material;
  TitleArguments title;
};

/// Sets the included sample as the input: its stereo pair, its calibration and, unless others are given, its
/// title, description and names of objects. It is searched beside the installed program, then where it was
/// built. Errors: failed, if it is not found; invalid_input, if it is damaged.
Result<SceneArguments> with_sample(SceneArguments arguments);

/// Replaces kMapSample as the only input by the sample's file; its window, title and description are used
/// unless others are given. Other inputs stay. Errors: failed, if the sample is not found.
Result<void> resolve_sample(MakeArguments& make, TitleArguments& title);

}  // namespace palpable::cli
