// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/make_options.hpp"
#include "palpable/cli/material_options.hpp"
#include "palpable/cli/title_options.hpp"

namespace palpable::cli {

/// Everything on the command line that a scene is made from.
struct SceneArguments {
  MakeArguments make;
  MaterialArguments material;
  TitleArguments title;
};

/// The arguments with the sample that comes with the program for their input: its stereo pair, its
/// calibration and, unless others are given, its title, its description and the names of its objects. Looked
/// for beside an installed program, then where it was built. Errors: failed, where it is not there;
/// invalid_input for a damaged one.
Result<SceneArguments> with_sample(SceneArguments arguments);

}  // namespace palpable::cli
