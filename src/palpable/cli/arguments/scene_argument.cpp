// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"

#include "palpable/sources/input/input.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct KindWords {
  sources::InputKind kind;
  std::string_view words;
};
constexpr KindWords kKindWords[]{{sources::InputKind::picture, "a picture"},
                                 {sources::InputKind::stereo, "a stereo picture"},
                                 {sources::InputKind::depth, "a depth map"},
                                 {sources::InputKind::video, "a video"},
                                 {sources::InputKind::map, "a map"},
                                 {sources::InputKind::mesh, "a mesh"},
                                 {sources::InputKind::points, "a point cloud"},
                                 {sources::InputKind::shapes, "a list of shapes"},
                                 {sources::InputKind::level_set, "an OpenVDB level set"}};

std::string_view words_of(sources::InputKind kind) {
  for (const KindWords& known : kKindWords)
    if (known.kind == kind) return known.words;
  return sources::name_of(kind);
}

/// A word quoted for a shell if it contains unusual characters.
std::string shell_word(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 ||
           std::string_view("/._-+,:@%=").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The kind of an input, unless it is a scene or cannot be recognised.
std::optional<sources::InputKind> other_kind_of(const std::filesystem::path& path) {
  const auto input = sources::recognise_input(std::span(&path, 1));
  if (!input || input->kind == sources::InputKind::scene) return std::nullopt;
  return input->kind;
}

/// The error `reason`, or, if the file can be recognised as an input, a message about that.
Error not_a_scene(const std::filesystem::path& path, Error reason) {
  const auto kind = other_kind_of(path);
  if (!kind) return reason;
  const std::string file = shell_word(path.string()), scene = shell_word(path.stem().string() + ".palp");
  return invalid_input(
      fmt::format("is {}, and not a scene: make a scene of it first with 'palpable make {} -o {}'",
                  words_of(*kind), file, scene),
      path.string());
}

}  // namespace

Result<formats::SceneFile> read_scene_argument(const std::filesystem::path& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return invalid_input(std::filesystem::is_directory(status)
                             ? "is a folder, and not a scene"
                             : "is not a regular file: a scene cannot be read from a pipe or a device",
                         path.string());
  auto file = formats::read_scene(path);
  if (!file) return not_a_scene(path, std::move(file).error());
  return file;
}

Error not_a_mesh(const std::filesystem::path& path, Error reason) {
  const auto kind = other_kind_of(path);
  if (!kind || *kind == sources::InputKind::mesh) return reason;
  return invalid_input(fmt::format("is {}, and not a mesh (OBJ, PLY, STL, GLB)", words_of(*kind)),
                       path.string());
}

Result<void> check_scene_name(const std::filesystem::path& path) {
  if (path.extension() == ".palp") return {};
  return Error{ErrorCode::usage,
               fmt::format("a scene's file name ends in .palp: write {}",
                           std::filesystem::path(path).replace_extension(".palp").filename().string()),
               path.string()};
}

}  // namespace palpable::cli
