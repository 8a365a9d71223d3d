// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/read_input.hpp"

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/formats/scene/superquadric_json.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/session/make/places.hpp"
#include "palpable/session/make/read_depth_maps.hpp"
#include "palpable/session/make/read_video_input.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/solid/points_file.hpp"

#include <string>
#include <utility>

namespace palpable::session {
namespace {

using sources::InputKind;

template <class T>
Result<ReadInput> values_of(Result<T> read) {
  if (!read) return read.error();
  return ReadInput{std::move(*read), {}};
}

Result<ReadInput> read_depth(const sources::Input& input, const InputOptions& options) {
  const auto settings = depth_settings(options);
  if (!settings) return settings.error();
  auto read = sources::read_depth_picture(input.files, *settings);
  if (!read) return read.error();
  std::vector<Note> notes = input.notes;
  notes.insert(notes.end(), read->notes.begin(), read->notes.end());
  return ReadInput{recipes::DepthInput{std::move(read->depth), std::move(read->colour)}, std::move(notes)};
}

Result<ReadInput> read_pair(const InputOptions& options, const Work& work) {
  auto pair = read_stereo_pair({options.files, options.calibration, options.layout, options.rectification,
                                options.moved_m, options.most_pair_pixels},
                               work);
  if (!pair) return pair.error();
  std::vector<Note> notes = pair->notes;
  return ReadInput{std::move(*pair), std::move(notes)};
}

Result<ReadInput> read_extract(const std::filesystem::path& file, const InputOptions& options,
                               const Work& work) {
  work.report(0.0, "reading the extract");
  const auto extract = sources::read_map_extract(file);
  if (!extract) return extract.error();
  auto window = sources::street_map_of(*extract, options.window);
  if (!window) return at_place(window.error(), file.string());
  return ReadInput{std::move(window->map), std::move(window->notes)};
}

Result<ReadInput> read_scene_file(const InputOptions& options) {
  if (options.files.size() != 1) return Error{ErrorCode::usage, "a scene is one file", {}};
  auto file = formats::read_scene(options.files.front());
  if (!file) return file.error();
  return ReadInput{std::move(file->scene), {}};
}

}  // namespace

bool holds_depth_maps(const InputOptions& options) {
  return !options.poses.empty() || (options.kind == InputKind::depth && options.files.size() > 2);
}

Result<sources::Input> recognise(const InputOptions& options) {
  if (holds_depth_maps(options)) return sources::Input{InputKind::depth, options.files, {}};
  return sources::recognise_input(options.files, options.kind);
}

Result<ReadInput> read_input(const sources::Input& input, const InputOptions& options, const Work& work) {
  if (holds_depth_maps(options)) return read_depth_maps(options, work);
  const auto& file = input.files.front();
  switch (input.kind) {
    case InputKind::picture:
      return values_of(read_one_picture(options));
    case InputKind::stereo:
      return read_pair(options, work);
    case InputKind::depth:
      return read_depth(input, options);
    case InputKind::mesh:
      work.report(0.0, "reading the mesh");
      return values_of(sources::read_mesh(file));
    case InputKind::points:
      work.report(0.0, "reading the points");
      return values_of(sources::read_points(file));
    case InputKind::shapes:
      return values_of(formats::read_superquadrics(file));
    case InputKind::level_set:
      work.report(0.0, "reading the level set");
      return values_of(formats::read_vdb(file));
    case InputKind::scene:
      return read_scene_file(options);
    case InputKind::video:
      return read_video_input(input, options, work);
    case InputKind::map:
      return read_extract(file, options, work);
  }
  return Error{ErrorCode::usage, "this kind of file cannot be read", names_of(input.files)};
}

Result<Image> read_one_picture(const InputOptions& options) {
  if (options.files.size() != 1) return Error{ErrorCode::usage, "contours are made of one picture", {}};
  return sources::read_picture(options.files.front());
}

}  // namespace palpable::session
