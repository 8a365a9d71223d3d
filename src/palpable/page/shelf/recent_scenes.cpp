// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/recent_scenes.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/system/secret.hpp"
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSceneFile = ".palp";
constexpr const char* kPicture = ".png";
constexpr const char* kCard = ".json";
constexpr std::size_t kIdLength = 32;
constexpr std::uintmax_t kLongestCard = 16384;

bool is_id(std::string_view id) {
  return id.size() == kIdLength && id.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Whether it is a regular file itself: what a link names is not the shelf's.
bool is_own_file(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == fs::file_type::regular;
}

/// Errors are ignored: the folder is used if it is there, no link, and only this user's.
bool make_private(const fs::path& folder) {
  if (folder.empty()) return false;
  std::error_code error;
  fs::create_directories(folder, error);
  return fs::symlink_status(folder, error).type() == fs::file_type::directory &&
         ::chmod(folder.c_str(), S_IRWXU) == 0;
}

std::optional<SceneCard> read_card(const fs::path& path) {
  std::error_code error;
  if (!is_own_file(path) || fs::file_size(path, error) > kLongestCard || error) return std::nullopt;
  const auto file = read_file(path);
  if (!file) return std::nullopt;
  const auto json = nlohmann::json::parse(as_text(*file), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto text = [&](const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  return SceneCard{text("title"), text("kind"), text("sentence")};
}

Error failure(const std::error_code& error, const fs::path& path) {
  return {ErrorCode::failed, error.message(), path.string()};
}

/// Also between file systems.
Result<void> move_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error == std::errc::cross_device_link) {
    const auto bytes = read_file(from);
    if (!bytes) return bytes.error();
    if (auto written = write_file_atomically(to, *bytes); !written) return written;
    error.clear();
    fs::remove(from, error);
  }
  if (error) return failure(error, to);
  ::chmod(to.c_str(), S_IRUSR | S_IWUSR);
  return {};
}

}  // namespace

fs::path user_state_folder() {
  const auto absolute = [](const char* name) {
    const char* const value = std::getenv(name);
    const fs::path path = value != nullptr ? value : "";
    return path.is_absolute() ? path : fs::path();
  };
  if (const fs::path state = absolute("XDG_STATE_HOME"); !state.empty()) return state / "palpable" / "scenes";
  if (const fs::path home = absolute("HOME"); !home.empty())
    return home / ".local" / "state" / "palpable" / "scenes";
  return {};
}

RecentScenes::RecentScenes(const fs::path& folder, const fs::path& instead, RecentLimits limits)
    : are_lasting_(make_private(folder)), folder_(are_lasting_ ? folder : instead), limits_(limits) {}

fs::path RecentScenes::file(std::string_view id, const char* ending) const {
  return folder_ / (std::string(id) + ending);
}

std::vector<RecentScene> RecentScenes::list() const {
  std::vector<std::pair<fs::file_time_type, RecentScene>> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    const std::string id = path.stem().string();
    if (path.extension() != kSceneFile || !is_id(id) || !is_own_file(path)) continue;
    std::error_code none;
    const auto time = fs::last_write_time(path, none);
    const auto card = read_card(file(id, kCard));
    if (none || !card) continue;
    found.emplace_back(time, RecentScene{id, *card, is_own_file(file(id, kPicture))});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::pair(b.first, b.second.id) < std::pair(a.first, a.second.id);
  });
  std::vector<RecentScene> scenes;
  for (auto& [time, scene] : found) scenes.push_back(std::move(scene));
  return scenes;
}

Result<std::string> RecentScenes::add(const fs::path& scene, const SceneCard& card,
                                      const Raster<Rgb8>& picture) {
  auto id = random_secret();
  if (!id) return id.error();
  const nlohmann::json json{{"title", card.title}, {"kind", card.kind}, {"sentence", card.sentence}};
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (auto written = write_file_atomically(file(*id, kCard), std::as_bytes(std::span(text))); !written)
    return written.error();
  ::chmod(file(*id, kCard).c_str(), S_IRUSR | S_IWUSR);
  // Without a picture the shelf shows the words alone.
  if (!picture.empty() && formats::write_png(file(*id, kPicture), picture))
    ::chmod(file(*id, kPicture).c_str(), S_IRUSR | S_IWUSR);
  // The scene last: list() shows none that is not whole.
  if (auto moved = move_file(scene, file(*id, kSceneFile)); !moved) {
    forget(*id);
    return moved.error();
  }
  note_opened(*id);
  keep_limits();
  return id;
}

Result<void> RecentScenes::replace(std::string_view id, const fs::path& path) {
  if (!scene(id)) return {};
  return move_file(path, file(id, kSceneFile));
}

void RecentScenes::note_opened(std::string_view id) {
  std::error_code ignored;
  if (is_id(id)) fs::last_write_time(file(id, kSceneFile), fs::file_time_type::clock::now(), ignored);
}

std::optional<fs::path> RecentScenes::scene(std::string_view id) const {
  if (!is_id(id) || !is_own_file(file(id, kSceneFile))) return std::nullopt;
  return file(id, kSceneFile);
}

std::optional<fs::path> RecentScenes::picture(std::string_view id) const {
  if (!is_id(id) || !is_own_file(file(id, kPicture))) return std::nullopt;
  return file(id, kPicture);
}

void RecentScenes::forget(std::string_view id) {
  if (!is_id(id)) return;
  std::error_code ignored;
  for (const char* const ending : {kSceneFile, kPicture, kCard}) fs::remove(file(id, ending), ignored);
}

void RecentScenes::forget_all() {
  for (const RecentScene& one : list()) forget(one.id);
}

void RecentScenes::keep_limits() {
  std::uint64_t bytes = 0;
  std::size_t scenes = 0;
  for (const RecentScene& one : list()) {
    std::error_code error;
    const auto size = fs::file_size(file(one.id, kSceneFile), error);
    bytes += error ? 0 : size;
    // The one that was added last stays, however large it is: it is being touched.
    if (++scenes > 1 && (scenes > limits_.most_scenes || bytes > limits_.most_bytes)) forget(one.id);
  }
}

}  // namespace palpable::page::shelf
