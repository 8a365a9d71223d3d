// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/models/scene/scene.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace palpable::cli {

/// What a scene's file states of how it was made, as the command line that is running says it.
struct MakingWords {
  std::function<std::vector<std::string>()> command;
  std::function<std::vector<std::filesystem::path>()> files;
};
MakingWords making_words(const Options& options);

/// Notes in the scene how it is being made: the command, and its files with their hashes. A command or files
/// beyond the limits of a scene are left out. Errors: as session::source_files().
Result<void> add_making(const MakingWords& words, models::Scene& scene, const Work& work);

/// Makes a saved scene again, with the same command and the same files, and writes it to `output`. The answer
/// is that of the command, and whether the scene is the same to the last bit (all but where it came from).
/// Errors: invalid_input for a scene that does not state how it was made, states another command than `make`
/// and `correct`, or one that writes other files; as session::find_source_files() and the command.
Result<Answer> make_again(const std::string& scene, const std::string& output, Console& console);

}  // namespace palpable::cli
