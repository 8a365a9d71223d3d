// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/unsaved_scene.hpp"

#include "palpable/formats/scene/scene_file.hpp"

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::formats {
namespace {

std::filesystem::path copy_number(int k, const std::filesystem::path& save_as) {
  const std::string number = k == 1 ? "" : "-" + std::to_string(k);
  return save_as.parent_path() / (save_as.stem().string() + "-unsaved" + number + ".palp");
}

/// Creates the first copy that does not exist, empty, so that no other touch takes it.
std::filesystem::path taken_copy(const std::filesystem::path& save_as) {
  constexpr int kMost = 1000;
  for (int k = 1; k <= kMost; ++k) {
    auto copy = copy_number(k, save_as);
    const int file = ::open(copy.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) continue;
    if (file >= 0) ::close(file);
    return copy;
  }
  return copy_number(kMost, save_as);
}

}  // namespace

UnsavedScene::UnsavedScene(std::filesystem::path save_as)
    : save_as_(std::move(save_as)), known_(state_of(save_as_)) {}

UnsavedScene::FileState UnsavedScene::state_of(const std::filesystem::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return {};
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  return {found.st_dev, found.st_ino, found.st_size, found.st_mtim.tv_sec * kNsPerS + found.st_mtim.tv_nsec};
}

Result<void> UnsavedScene::save(const models::Scene& scene) {
  // Opening a pipe waits for its reader, and a touch goes on meanwhile.
  std::error_code none;
  if (const auto there = std::filesystem::status(save_as_, none);
      std::filesystem::exists(there) && !is_regular_file(there) && !is_directory(there))
    return Error{ErrorCode::failed, "is not a file that a scene can replace", save_as_.string()};
  const FileState found = state_of(save_as_);
  if (found != FileState{} && found != std::exchange(known_, found))
    return Error{ErrorCode::failed, "changed by another program meanwhile; save again to replace it",
                 save_as_.string()};
  if (auto written = write_scene(save_as_, scene); !written) return written;
  known_ = state_of(save_as_);
  discard();
  return {};
}

Result<void> UnsavedScene::keep(const models::Scene& scene) {
  const auto copy = file_.empty() ? taken_copy(save_as_) : file_;
  if (auto written = write_scene(copy, scene); !written) {
    std::error_code ignored;
    if (file_.empty() && std::filesystem::file_size(copy, ignored) == 0)
      std::filesystem::remove(copy, ignored);
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

std::filesystem::path UnsavedScene::of_earlier_touch(const std::filesystem::path& save_as) {
  std::error_code ignored;
  const auto copy = copy_number(1, save_as);
  // An empty one belongs to a touch that is about to write it.
  const auto bytes = std::filesystem::file_size(copy, ignored);
  return !ignored && bytes > 0 ? copy : std::filesystem::path();
}

}  // namespace palpable::formats
