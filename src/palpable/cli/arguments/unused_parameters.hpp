// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/make_options.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// Parameters that were given with --set and have no effect on the scene.
struct UnusedParameters {
  /// Their step is not used for this kind of scene from this kind of input.
  std::vector<std::string> of_other_scenes;
  /// One sentence for each choice that excludes some: "detail.bilateral.range has no effect with --detail
  /// relief."
  std::vector<std::string> sentences;
};

/// The parameters of `arguments` without an effect on a scene of this kind ("relief", as models::kind_of())
/// from this kind of input. Parameters within a step and a method that are used are not listed, even if
/// nothing in this input depends on them.
UnusedParameters unused_parameters(const MakeArguments& arguments, const session::MakeOptions& options,
                                   sources::InputKind input, const std::string& made);

}  // namespace palpable::cli
