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

/// The sample that `touch` begins with: a stereo pair.
inline constexpr const char* kFirstSample = "sample:sculptures";

/// Replaces sample:NAME as the only input by the sample's files, with its calibration or window and, unless
/// others are given, its title, description and names of objects. Other inputs stay. Samples are searched
/// beside the installed program, then where it was built. Errors: usage for an unknown name; failed, if the
/// sample is not found; invalid_input, if it is damaged.
Result<void> resolve_sample(MakeArguments& make, TitleArguments& title, MaterialArguments& material);

}  // namespace palpable::cli
