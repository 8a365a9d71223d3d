// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/unsaved_scene.hpp"

#include "palpable/formats/scene/scene_file.hpp"

#include <string>
#include <system_error>
#include <utility>

namespace palpable::formats {
namespace {

std::filesystem::path free_copy(const std::filesystem::path& save_as) {
  const std::string stem = save_as.stem().string() + "-unsaved";
  auto copy = save_as.parent_path() / (stem + ".palp");
  std::error_code ignored;
  for (int k = 2; std::filesystem::exists(copy, ignored); ++k)
    copy = save_as.parent_path() / (stem + "-" + std::to_string(k) + ".palp");
  return copy;
}

}  // namespace

Result<void> UnsavedScene::keep(const models::Scene& scene) {
  const auto copy = file_.empty() ? free_copy(save_as_) : file_;
  if (auto written = write_scene(copy, scene); !written) {
    if (std::exchange(failed_, true)) return {};
    return written;
  }
  file_ = copy;
  return {};
}

void UnsavedScene::discard() {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
  file_.clear();
}

}  // namespace palpable::formats
