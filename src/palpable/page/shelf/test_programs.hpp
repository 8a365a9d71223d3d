// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Programs that stand for `palpable make` in the tests of the home page.

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/relief/relief.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace palpable::page::shelf {

/// A new empty folder for a test.
inline std::filesystem::path new_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// A program of these shell commands. Its report goes to descriptor 3; $out is the file that it is to write.
inline std::filesystem::path program_of(const std::filesystem::path& folder, const std::string& commands) {
  static int count = 0;
  const auto path = folder / ("program-" + std::to_string(++count));
  std::ofstream(path) << "#!/bin/sh\nout=\nfor word; do if [ \"$before\" = -o ]; then out=$word; fi; "
                         "before=$word; done\n"
                      << commands << "\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

inline models::Scene test_scene() {
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(
      models::Relief::from_samples(Raster<float>(16, 12, 0.001F), 0.001).value());
  scene.title = "A level";
  return scene;
}

}  // namespace palpable::page::shelf
