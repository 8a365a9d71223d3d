// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/console.hpp"
#include "palpable/recipes/map_recipe.hpp"
#include "palpable/session/make/maker_thread.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <filesystem>

namespace palpable::cli {

struct KeyTouchOptions {
  session::TouchSettings settings;
  session::SessionOptions session;
  std::int64_t begin_ns = 0;
  /// Empty = no recording.
  std::filesystem::path recording;
  /// Whether the answers are spoken too.
  bool aloud = false;
  /// How parts of a street map become scenes when the user zooms.
  recipes::MapRecipe map;
  /// Where the scene is saved with its names.
  std::filesystem::path save_as;
};

/// Runs a touch in the terminal: keys move the probe and ask questions; the answers are printed, one line
/// each, for a braille display or a terminal's screen reader. It ends with Q, at the end of standard input,
/// or when interrupted. Errors: the maker's if there was no scene; the session's and the recording's.
Result<session::TouchStatistics> touch_by_keys(const session::SceneMaker& make,
                                               const KeyTouchOptions& options, Console& console);

}  // namespace palpable::cli
