// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/make_scene.hpp"

#include "palpable/recipes/relief/regions.hpp"
#include "palpable/session/make/places.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace palpable::session {
namespace {

using recipes::MadeScene;
using sources::InputKind;

bool is_solid(InputKind kind) {
  return kind == InputKind::mesh || kind == InputKind::points || kind == InputKind::shapes ||
         kind == InputKind::level_set;
}

bool is_map(const MakeOptions& options) { return options.as == MakeAs::map; }

/// An extract becomes a map without being asked for one.
bool is_extract(const MakeOptions& options, const sources::Input& input) {
  return input.kind == InputKind::map && (is_map(options) || options.as == MakeAs::by_input);
}

bool is_contours(const MakeOptions& options, const sources::Input& input) {
  if (holds_depth_maps(options.input)) return false;
  return options.as == MakeAs::contours ||
         (options.as == MakeAs::by_input && input.kind == InputKind::picture);
}

/// Ground and background are detected in the depth of one camera: from a pair, or one depth map.
bool has_regions(const MakeOptions& options, const sources::Input& input) {
  return !holds_depth_maps(options.input) && !is_contours(options, input) &&
         (input.kind == InputKind::stereo || input.kind == InputKind::depth);
}

/// Only the first names: a folder may contain thousands of pictures.
std::string few_names_of(const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t kNamed = 2;
  if (files.size() <= kNamed) return names_of(files);
  return files.front().string() + " and " + std::to_string(files.size() - 1) + " more";
}

Error cannot_become(const sources::Input& input) {
  const std::string what = input.kind == InputKind::video
                               ? "a video can only become a field so far"
                               : "a " + std::string(sources::name_of(input.kind)) +
                                     " cannot become the kind of scene that is asked for";
  return {ErrorCode::usage, what, few_names_of(input.files), Reason::unexpected_input_kind};
}

/// Checks that this input can be made into the requested kind of scene, before it is read.
Result<void> check_kind(const sources::Input& input, const MakeOptions& options) {
  const bool field_by_input = options.as == MakeAs::field || options.as == MakeAs::by_input;
  if (holds_depth_maps(options.input)) {
    if (field_by_input) return {};
    return Error{ErrorCode::usage, "several depth maps can only become a field so far",
                 names_of(options.input.files)};
  }
  if (is_contours(options, input)) return {};
  if (is_extract(options, input) || (is_map(options) && input.kind == InputKind::picture)) return {};
  if (is_map(options))
    return Error{ErrorCode::usage, "a map is made of a single picture that is no depth map, or of an extract",
                 names_of(input.files)};
  const bool adaptive = options.recipes.field.storage == recipes::FieldStorage::adaptive;
  const bool becomes_field = is_solid(input.kind) || input.kind == InputKind::video;
  if (!adaptive && options.as != MakeAs::field && !becomes_field)
    return Error{ErrorCode::usage, "dense storage is for fields, and this does not become one",
                 names_of(input.files), Reason::needs_field};
  const bool possible = field_by_input || (input.kind == InputKind::mesh && options.as == MakeAs::relief);
  if (becomes_field) return possible ? Result<void>() : cannot_become(input);
  if (input.kind == InputKind::scene || input.kind == InputKind::depth || input.kind == InputKind::stereo)
    return {};
  return cannot_become(input);
}

/// Returns the relief, or the volume below it if a field or a grid is requested (Park & Howard 2012).
Result<MadeScene> filled(Result<MadeScene> made, const MakeOptions& options, const Work& work) {
  if (!made) return made;
  if (options.as == MakeAs::field) return field_from_relief(std::move(*made), options.recipes.field, work);
  if (options.as == MakeAs::grid) return grid_from_relief(std::move(*made), options.recipes.grid, work);
  return made;
}

/// Whether a mesh is made into a relief of one of its sides.
bool becomes_relief(const Mesh& mesh, const MakeOptions& options) {
  return options.as == MakeAs::relief ||
         (options.as == MakeAs::by_input && sculpt::is_open_sheet(mesh, options.recipes.sheet));
}

recipes::VideoRecipe recipe_of(const VideoInput& video, const MakeOptions& options) {
  recipes::VideoRecipe recipe = options.recipes.video;
  recipe.fusion = options.recipes.fusion;
  recipe.field = options.recipes.field;
  // What is asked for is recipe.surface, of the depth maps.
  recipe.field.surface = recipes::SolidSurface::given;
  recipe.reduction = video.reduction;
  if (recipe.length)
    for (vision::ImagePoint* at : {&recipe.length->from, &recipe.length->to})
      at->x = (at->x + 0.5) * video.reduction - 0.5, at->y = (at->y + 0.5) * video.reduction - 0.5;
  return recipe;
}

/// Runs the recipe that fits the values.
struct RunRecipe {
  const MakeOptions& options;
  const Work& work;

  Result<MadeScene> operator()(Image picture) const {
    if (is_map(options)) return map_from_picture(std::move(picture), options.recipes.map, work);
    return contours_from_picture(std::move(picture), options.recipes.contours, work);
  }
  Result<MadeScene> operator()(const ReadyPair& ready) const {
    const auto& recipe = options.recipes;
    if (options.as == MakeAs::grid && recipe.grid.filling == recipes::GridFilling::from_camera)
      return grid_from_pair(ready.pair, recipe.stereo, recipe.relief, recipe.grid, work);
    return filled(relief_from_pair(ready.pair, options.recipes.stereo, options.recipes.relief, work), options,
                  work);
  }
  Result<MadeScene> operator()(recipes::DepthInput depth) const {
    return filled(relief_from_depth(std::move(depth), options.recipes.relief, work), options, work);
  }
  Result<MadeScene> operator()(const VideoInput& video) const {
    return field_from_video(video.frames, video.camera, recipe_of(video, options), work);
  }
  Result<MadeScene> operator()(const std::vector<recipes::PosedDepth>& views) const {
    return field_from_depth_maps(views, {options.recipes.fusion, options.recipes.field}, work);
  }
  Result<MadeScene> operator()(sources::MeshFile file) const {
    recipes::FieldRecipe field = options.recipes.field;
    field.placement.convention = file.convention;
    if (!becomes_relief(file.mesh, options)) return field_from_mesh(std::move(file.mesh), field, work);
    const recipes::SheetRecipe sheet{field.placement, options.recipes.sheet};
    auto made = recipes::relief_from_mesh(std::move(file.mesh), sheet, work);
    if (made && options.as == MakeAs::by_input)
      made->notes.emplace(
          made->notes.begin(),
          "The mesh is an open sheet, which encloses no solid: it became a relief of the side "
          "that it faces.");
    return made;
  }
  Result<MadeScene> operator()(PointCloud cloud) const {
    return field_from_points(std::move(cloud), options.recipes.field, work);
  }
  Result<MadeScene> operator()(std::vector<models::Superquadric> shapes) const {
    return field_from_superquadrics(std::move(shapes), options.recipes.field, work);
  }
  Result<MadeScene> operator()(const LevelSet& set) const {
    return field_from_level_set(set, options.recipes.field, work);
  }
  Result<MadeScene> operator()(StreetMap map) const {
    return map_from_extract(std::move(map), options.recipes.map);
  }
  Result<MadeScene> operator()(models::Scene scene) const {
    const bool is_it = (options.as == MakeAs::field && models::is_field(scene.model)) ||
                       (options.as == MakeAs::grid &&
                        std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model));
    std::vector<Note> warnings(scene.warnings.begin(), scene.warnings.end());
    MadeScene made{std::move(scene), std::move(warnings)};
    return is_it ? std::move(made) : filled(std::move(made), options, work);
  }
};

/// The input's values, ready for the recipe.
struct Prepared {
  InputValues values;
  std::vector<Note> notes;
  /// Notes to be listed after those of the recipe.
  std::vector<Note> last_notes;
  /// The place of the recipe's errors.
  std::string place;
};

Result<Prepared> prepared(const MakeOptions& options, const Work& work) {
  const auto input = recognise(options.input);
  if (!input) return input.error();
  if (const auto possible = check_kind(*input, options); !possible) return possible.error();
  Prepared out;
  if (is_contours(options, *input) || (is_map(options) && input->kind == InputKind::picture)) {
    auto picture = read_one_picture(options.input);
    if (!picture) return picture.error();
    out.values = std::move(*picture);
    // Notes about recognising the content as a picture, if the user did not state the kind.
    if (options.as == MakeAs::by_input) out.notes = input->notes;
  } else {
    auto read = read_input(*input, options.input, work);
    if (!read) return read.error();
    out.values = std::move(read->values);
    out.notes = std::move(read->notes);
  }
  // In a pair of colour picture and depth map, the depth map is second.
  out.place = input->kind == InputKind::depth ? input->files.back().string() : few_names_of(input->files);
  if (asks_for_regions(options.recipes.relief) && !has_regions(options, *input))
    out.last_notes.emplace_back(
        "Ground and background are found in pairs and single depth maps only: these options have no effect "
        "here.",
        Reason::no_regions_in_input);
  return out;
}

/// Completes the recipe's result: provenance (unless it comes from a scene file) and all notes.
Result<MadeScene> finished(Result<MadeScene> made, const Prepared& from, const MakeOptions& options) {
  if (!made) return at_place(made.error(), from.place);
  if (!std::holds_alternative<models::Scene>(from.values)) {
    for (const auto& file : options.input.files) made->scene.source.inputs.push_back(file.string());
    made->scene.source.made_by = options.made_by;
  }
  made->notes.insert(made->notes.begin(), from.notes.begin(), from.notes.end());
  made->notes.insert(made->notes.end(), from.last_notes.begin(), from.last_notes.end());
  return made;
}

/// The cache key of a mesh whose field is cached; nullopt for other scenes.
std::optional<std::string> key_of(const InputValues& values, const MakeOptions& options) {
  const auto* file = std::get_if<sources::MeshFile>(&values);
  const bool is_cached = file != nullptr && !options.cache.folder.empty() &&
                         !becomes_relief(file->mesh, options) &&
                         options.recipes.field.storage == recipes::FieldStorage::adaptive &&
                         options.recipes.field.surface == recipes::SolidSurface::given;
  if (!is_cached) return std::nullopt;
  recipes::FieldRecipe recipe = options.recipes.field;
  recipe.placement.convention = file->convention;
  return cache_key(file->mesh, recipe, options.made_by);
}

std::optional<MadeScene> from_cache(const MakeOptions& options, const std::optional<std::string>& key) {
  auto made = key ? read_cached(options.cache, *key) : std::nullopt;
  if (made) made->notes.emplace_back("This scene was made before and came from the cache.");
  return made;
}

/// Runs the recipe and stores the result under the key, if there is one.
Result<MadeScene> made_for_cache(InputValues values, const MakeOptions& options,
                                 const std::optional<std::string>& key, const Work& work) {
  auto made = std::visit(RunRecipe{options, work}, std::move(values));
  if (made && key) write_cached(options.cache, *key, *made);
  return made;
}

/// The options of a coarse field that is ready soon, to be touched while the requested one is computed;
/// nullopt for other scenes, and if the requested field does not take long.
std::optional<MakeOptions> coarse_first(const InputValues& values, const MakeOptions& options) {
  const auto* file = std::get_if<sources::MeshFile>(&values);
  if (file == nullptr || becomes_relief(file->mesh, options)) return std::nullopt;
  const auto coarse = coarse_recipe(options.coarse_field, file->mesh, options.recipes.field);
  if (!coarse) return std::nullopt;
  MakeOptions first = options;
  first.recipes.field = *coarse;
  return first;
}

/// Only the requested scene reports progress to the user.
Work without_progress(Work work) {
  work.progress = {};
  return work;
}

/// The scene of a video's quick version; nullopt for other values, or if it cannot be made.
std::optional<MadeScene> quick_scene(const InputValues& values, const MakeOptions& options,
                                     const Work& work) {
  const auto* video = std::get_if<VideoInput>(&values);
  const QuickVideo& quick = options.quick_video;
  if (video == nullptr || quick.most_frames == 0) return std::nullopt;
  const VideoInput small = quick_video(*video, quick);
  auto made = field_from_video(small.frames, small.camera, quick_recipe(recipe_of(small, options), quick),
                               without_progress(work));
  if (!made) return std::nullopt;
  made->video.reset();
  made->notes = {Note("This is a first, coarse model; a better one follows while you touch it.")};
  return std::move(*made);
}

}  // namespace

Result<MadeScene> make_scene(const MakeOptions& options, const Work& work) {
  auto from = prepared(options, work);
  if (!from) return from.error();
  const auto key = key_of(from->values, options);
  if (auto made = from_cache(options, key)) return finished(std::move(*made), *from, options);
  return finished(made_for_cache(std::move(from->values), options, key, work), *from, options);
}

Result<void> make_scenes(const MakeOptions& options, const TakeScene& take, const Work& work) {
  auto from = prepared(options, work);
  if (!from) return from.error();
  const auto* pair = std::get_if<ReadyPair>(&from->values);
  if (pair == nullptr) {
    const auto key = key_of(from->values, options);
    if (auto made = from_cache(options, key)) {
      take(*finished(std::move(*made), *from, options));
      return {};
    }
    if (const auto coarse = coarse_first(from->values, options)) {
      auto made =
          finished(std::visit(RunRecipe{*coarse, without_progress(work)}, from->values), *from, *coarse);
      if (!made) return made.error();
      take(std::move(*made));
    }
    auto quick = quick_scene(from->values, options, work);
    const bool begun = quick.has_value();
    if (begun) take(*finished(*std::exchange(quick, std::nullopt), *from, options));
    MakeOptions growing = options;
    growing.recipes.video.grown = [&](MadeScene state) { take(*finished(std::move(state), *from, options)); };
    auto made = finished(made_for_cache(std::move(from->values), growing, key, work), *from, options);
    if (!made) return made.error();
    if (begun) made->notes.emplace(made->notes.begin(), "The best model is ready: from now on you touch it.");
    take(std::move(*made));
    return {};
  }
  for (const vision::StereoMethod method : recipes::progressive_methods(options.recipes.stereo)) {
    MakeOptions with_method = options;
    with_method.recipes.stereo.method = method;
    auto made = finished(RunRecipe{with_method, work}(*pair), *from, options);
    if (!made) return made.error();
    take(std::move(*made));
  }
  return {};
}

}  // namespace palpable::session
