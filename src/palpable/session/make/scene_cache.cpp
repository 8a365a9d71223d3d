// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/scene_cache.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/crc32.hpp"
#include "palpable/core/files/fnv1a.hpp"
#include "palpable/formats/scene/scene_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;

/// The member of an entry that contains its key and the notes.
constexpr const char* kMember = "cache.json";
constexpr const char* kEnding = ".palp";

fs::path path_of(const SceneCache& cache, const std::string& key) {
  Fnv1a hash;
  hash.add(std::string_view(key));
  return cache.folder / (hash.digits() + kEnding);
}

std::string text_of(const Mesh& mesh) {
  Fnv1a hash;
  for (const Vec3 v : mesh.vertices_m)
    for (const double c : {v.x, v.y, v.z}) hash.add(c);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) hash.add(v);
  // Two hashes of different kinds: a collision of both is practically impossible.
  return fmt::format("{} vertices, {} triangles, {} {:08x}", mesh.vertices_m.size(), mesh.triangles.size(),
                     hash.digits(), crc32(std::as_bytes(std::span(mesh.vertices_m))));
}

/// All members are named, so that a new one cannot be forgotten in the key (the compiler reports it).
std::string text_of(const sculpt::PlacementOptions& placement) {
  const auto& [size, default_size, up, lay, convention, plate_height, map_height, map_level, least_side_m,
               most_side_m, most_off_centre] = placement;
  const auto& [convention_up, unit] = convention;
  const std::string box = size ? fmt::format("{:a} {:a} {:a}", size->x, size->y, size->z) : "none";
  return fmt::format("{}; {}; {}; {}; {}; {}; {:a}; {:a}; {:a}; {:a}; {:a}; {:a}", box,
                     static_cast<int>(default_size), up ? static_cast<int>(*up) : -1, static_cast<int>(lay),
                     static_cast<int>(convention_up), static_cast<int>(unit), plate_height, map_height,
                     map_level, least_side_m, most_side_m, most_off_centre);
}
std::string text_of(const sculpt::FieldOptions& field) {
  // The memory limit decides whether there is a field, not its content.
  const auto& [resolution, max_error_m, inside_m, outside_m, margin_m, most_bytes] = field;
  static_cast<void>(most_bytes);
  return fmt::format("{}; {:a}; {:a}; {:a}; {:a}", resolution, max_error_m, inside_m, outside_m, margin_m);
}
std::string text_of(const sculpt::WallOptions& walls) {
  // Up follows from the placement.
  const auto& [least_cells, ground_height, ground_facing, ground_beyond, opposite_cosine, least_lack,
               least_points, thickness_steps, least_piece_cells, most_piece_cells, up] = walls;
  static_cast<void>(up);
  return fmt::format("{:a}; {:a}; {:a}; {:a}; {:a}; {:a}; {}; {}; {:a}; {:a}", least_cells, ground_height,
                     ground_facing, ground_beyond, opposite_cosine, least_lack, least_points, thickness_steps,
                     least_piece_cells, most_piece_cells);
}
std::string text_of(const sculpt::OpenSheetOptions& sheets) {
  const auto& [most_tall_lids, most_sharp_lids, sharp_angle_deg, most_lids, most_two_sided_lids, least_lid,
               least_outline_height, most_free_rim] = sheets;
  return fmt::format("{:a}; {:a}; {:a}; {:a}; {:a}; {:a}; {:a}; {:a}", most_tall_lids, most_sharp_lids,
                     sharp_angle_deg, most_lids, most_two_sided_lids, least_lid, least_outline_height,
                     most_free_rim);
}
std::string text_of(const recipes::FieldRecipe& recipe) {
  // Point clouds are not meshes; predicted surfaces are not cached.
  const auto& [placement, field, storage, walls, sheets, cloud, surface, prediction] = recipe;
  static_cast<void>(cloud);
  static_cast<void>(prediction);
  return fmt::format("{}; {}; {}; {}; {}; {}", text_of(placement), text_of(field), static_cast<int>(storage),
                     text_of(walls), text_of(sheets), static_cast<int>(surface));
}

/// The size and time of the running program's file.
std::string text_of_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto bytes = fs::file_size(program, error);
  const auto time = fs::last_write_time(program, error);
  return error ? "unknown" : fmt::format("{} {}", bytes, time.time_since_epoch().count());
}

struct Entry {
  fs::path path;
  std::uintmax_t bytes = 0;
  fs::file_time_type used;
};

/// All entries, the most recently used first.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    if (at->path().extension() != kEnding || !at->is_regular_file(gone)) continue;
    const Entry entry{at->path(), at->file_size(gone), at->last_write_time(gone)};
    // Another process may have removed it in the meantime.
    if (!gone) entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used > b.used; });
  return entries;
}

void remove_oldest(const SceneCache& cache) {
  std::uintmax_t sum = 0;
  for (const Entry& entry : entries_of(cache.folder)) {
    sum += entry.bytes;
    std::error_code ignored;
    if (sum > cache.most_bytes) fs::remove(entry.path, ignored);
  }
}

/// The notes of an entry with this key; nullopt for another key or a damaged member.
std::optional<std::vector<Note>> notes_of(const formats::ZipMembers& members, const std::string& key) {
  const auto member = members.find(kMember);
  if (member == members.end()) return std::nullopt;
  const auto* text = reinterpret_cast<const char*>(member->second.data());
  const auto json = nlohmann::json::parse(text, text + member->second.size(), nullptr, false);
  if (!json.is_object() || !json.contains("key") || json["key"] != key || !json.contains("notes") ||
      !json["notes"].is_array())
    return std::nullopt;
  std::vector<Note> notes;
  for (const auto& note : json["notes"]) {
    if (!note.is_string()) return std::nullopt;
    notes.emplace_back(note.get<std::string>());
  }
  return notes;
}

}  // namespace

fs::path user_cache_folder() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    const fs::path path = value != nullptr ? value : "";
    return path.is_absolute() ? path : fs::path();
  };
  if (const fs::path cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache / "palpable" / "scenes";
  if (const fs::path home = absolute("HOME"); !home.empty()) return home / ".cache" / "palpable" / "scenes";
  return {};
}

CacheLimit user_cache_limit() {
  constexpr const char* kVariable = "PALPABLE_CACHE_MB";
  const char* const value = std::getenv(kVariable);
  const std::string_view text = value != nullptr ? value : "";
  CacheLimit limit;
  if (text.empty()) return limit;
  std::uint32_t megabytes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), megabytes);
  if (error == std::errc() && end == text.data() + text.size()) {
    limit.bytes = std::uintmax_t{megabytes} * 1'000'000U;
  } else {
    limit.note = Note(fmt::format("{} is not a whole number of megabytes, so the cache takes at most {} MiB.",
                                  kVariable, limit.bytes >> 20U));
  }
  return limit;
}

std::string cache_key(const Mesh& mesh, const recipes::FieldRecipe& recipe, const std::string& made_by) {
  return fmt::format("{}; {}; {}; {}", made_by, text_of_program(), text_of(mesh), text_of(recipe));
}

std::optional<recipes::MadeScene> read_cached(const SceneCache& cache, const std::string& key) {
  const fs::path path = path_of(cache, key);
  std::error_code error;
  if (cache.folder.empty() || cache.most_bytes == 0 || !fs::is_regular_file(path, error)) return std::nullopt;
  auto file = formats::read_scene(path);
  if (!file) return std::nullopt;
  auto notes = notes_of(file->others, key);
  if (!notes) return std::nullopt;
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);
  return recipes::MadeScene{std::move(file->scene), std::move(*notes)};
}

void write_cached(const SceneCache& cache, const std::string& key, const recipes::MadeScene& made) {
  if (cache.folder.empty()) return;
  nlohmann::json json{{"key", key}, {"notes", nlohmann::json::array()}};
  for (const Note& note : made.notes) {
    // Notes with a reason depend on the caller's options; such scenes are not cached.
    if (note.reason != Reason::unspecified) return;
    json["notes"].push_back(note.sentence);
  }
  const std::string text = json.dump();
  const auto bytes = std::as_bytes(std::span(text));
  const auto file = formats::encode_scene(made.scene, {{kMember, {bytes.begin(), bytes.end()}}});
  if (!file || file->size() > cache.most_bytes) return;
  std::error_code error;
  if (fs::create_directories(cache.folder, error)) fs::permissions(cache.folder, fs::perms::owner_all, error);
  if (write_file_atomically(path_of(cache, key), *file)) remove_oldest(cache);
}

}  // namespace palpable::session
