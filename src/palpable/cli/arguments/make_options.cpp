// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/make_options.hpp"

#include "palpable/cli/arguments/known_length.hpp"
#include "palpable/cli/arguments/parameter_groups.hpp"
#include "palpable/cli/arguments/unused_options.hpp"
#include "palpable/cli/arguments/unused_parameters.hpp"
#include "palpable/cli/suggest.hpp"
#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

constexpr const char* kMadeBy = "palpable " PALPABLE_VERSION;

/// A kind of scene is given by another option.
std::string unknown_kind(const std::string& typed) {
  for (const char* const scene : {"relief", "contours", "field", "grid", "map"})
    if (typed == scene)
      return fmt::format("'{0}' is a kind of scene, not of input: did you mean --as {0}?", typed);
  return unknown_word(typed, input_kinds());
}

session::MakeAs make_as_from(const std::string& word) {
  if (word == "relief") return session::MakeAs::relief;
  if (word == "contours") return session::MakeAs::contours;
  if (word == "field") return session::MakeAs::field;
  if (word == "map") return session::MakeAs::map;
  return word == "grid" ? session::MakeAs::grid : session::MakeAs::by_input;
}

sources::DepthSettings depth_settings(const MakeArguments& arguments) {
  sources::DepthSettings settings;
  settings.meaning = sources::depth_meaning_from(arguments.depth_as);
  settings.metres_per_unit = arguments.depth_scale;
  if (arguments.near_plane) {
    sources::ZBuffer buffer;
    buffer.near_m = *arguments.near_plane;
    buffer.far_m = arguments.far_plane.value_or(std::numeric_limits<double>::infinity());
    settings.zbuffer = buffer;
  }
  return settings;
}

/// The placement of a solid; a solid without a size is fitted for a hand.
sculpt::PlacementOptions placement_options(const MakeArguments& arguments) {
  sculpt::PlacementOptions placement;
  placement.default_size = sculpt::DefaultSize::for_a_hand;
  placement.up = axis_direction_from(arguments.up);
  if (arguments.lay == "upright") placement.lay = sculpt::Lay::upright;
  if (arguments.lay == "flat") placement.lay = sculpt::Lay::flat;
  return placement;
}

Result<session::InputOptions> input_options(const MakeArguments& arguments) {
  session::InputOptions input;
  input.files.assign(arguments.inputs.begin(), arguments.inputs.end());
  input.calibration = arguments.stereo.calibration;
  input.poses = arguments.poses;
  input.depth = depth_settings(arguments);
  input.layout = layout_of(arguments.stereo);
  input.rectification = rectification_of(arguments.stereo);
  input.moved_m = moved_m_of(arguments.stereo);
  input.most_pair_pixels = most_pixels_of(arguments.stereo);
  const auto window = window_of(arguments.map);
  if (!window) return window.error();
  input.window = *window;
  if (arguments.kind.empty()) return input;
  input.kind = sources::input_kind_from(arguments.kind);
  if (!input.kind) return Error{ErrorCode::usage, unknown_kind(arguments.kind), "--kind"};
  return input;
}

Result<recipes::StereoRecipe> stereo_recipe(const MakeArguments& arguments) {
  recipes::StereoRecipe stereo;
  stereo.options.max_disparity_px = arguments.stereo.max_disparity_px;
  if (arguments.stereo.method.empty()) return stereo;
  const auto method = stereo_method(arguments.stereo);
  if (!method) return method.error();
  stereo.method = *method;
  return stereo;
}

Result<recipes::ReliefRecipe> relief_recipe(const MakeArguments& arguments) {
  recipes::ReliefRecipe recipe;
  sculpt::ReliefOptions& relief = recipe.relief;
  relief.near = arguments.near;
  relief.far = arguments.far;
  relief.exaggerate = arguments.exaggerate;
  relief.compression = arguments.compression;
  relief.steepest_slope = arguments.steepest_slope;
  if (arguments.height_of == "disparity") relief.height_of = sculpt::HeightOf::disparity;
  relief.smooth_m = arguments.smooth_mm / 1000.0;
  relief.detail = sculpt::detail_operator_from(arguments.detail).value_or(relief.detail);
  relief.resampling = sculpt::resampling_from(arguments.resample).value_or(relief.resampling);
  relief.samples_on_a_side = arguments.samples;
  relief.sense = arguments.engrave ? sculpt::Sense::engrave : sculpt::Sense::raise;
  if (arguments.background == "remove") recipe.background = recipes::BackgroundTreatment::remove;
  if (arguments.texture == "front") recipe.texture = recipes::Texture::front;
  if (arguments.texture == "none") recipe.texture = recipes::Texture::none;
  if (arguments.ground.empty()) return recipe;
  const auto ground = vision::ground_treatment_from(arguments.ground);
  if (!ground)
    return Error{ErrorCode::usage,
                 unknown_word(arguments.ground, std::vector<std::string>{"keep", "flatten", "remove"}),
                 "--ground"};
  recipe.ground = *ground;
  return recipe;
}

recipes::ContoursRecipe contours_recipe(const MakeArguments& arguments) {
  recipes::ContoursRecipe recipe;
  if (arguments.quality == "best") recipe.contours.method = vision::ContourMethod::best;
  if (arguments.contour_method == "paper") recipe.contours.method = vision::ContourMethod::paper;
  recipe.contours.threshold = arguments.threshold;
  recipe.map.radius_px = arguments.neighbourhood_px;
  recipe.grooves.width_m = arguments.groove_mm / 1000.0;
  return recipe;
}

Result<recipes::FieldRecipe> field_recipe(const MakeArguments& arguments) {
  if (arguments.dense && arguments.paper)
    return Error{ErrorCode::usage, "--dense and --paper exclude each other", {}};
  if ((arguments.dense || arguments.paper) && arguments.max_error_mm)
    return Error{ErrorCode::usage, "a dense field has no --max-error: its resolution decides", {}};
  recipes::FieldRecipe recipe;
  recipe.placement = placement_options(arguments);
  recipe.field.resolution = arguments.resolution.value_or(recipe.field.resolution);
  if (arguments.max_error_mm) recipe.field.max_error_m = *arguments.max_error_mm / 1000.0;
  if (arguments.dense) recipe.storage = recipes::FieldStorage::dense;
  if (arguments.paper) recipe.storage = recipes::FieldStorage::paper;
  if (arguments.surface == "superquadrics") recipe.surface = recipes::SolidSurface::superquadrics;
  if (arguments.surface == "corrected") recipe.surface = recipes::SolidSurface::corrected;
  return recipe;
}

Result<recipes::VideoRecipe> video_recipe(const MakeArguments& arguments) {
  recipes::VideoRecipe recipe;
  recipe.until = arguments.until;
  if (!arguments.length.empty()) {
    const auto length = known_length_from(arguments.length);
    if (!length) return length.error();
    recipe.length = *length;
  }
  if (arguments.motion == "filter") recipe.motion_method = recipes::VideoMotion::filter;
  if (arguments.surface == "superquadrics") recipe.surface = recipes::VideoSurface::superquadrics;
  if (arguments.surface == "corrected") recipe.surface = recipes::VideoSurface::corrected;
  return recipe;
}

/// Applies --set to the parameters of every step and of the stereo method.
Result<void> set_given(const MakeArguments& arguments, session::Recipes& recipes,
                       sculpt::ShapeSetOptions& shapes) {
  if (arguments.stereo.parameters.empty()) return {};
  SettableOptions settable{recipes, shapes, {}};
  const vision::StereoMethod method = recipes.stereo.method.value_or(recipes::default_method());
  std::vector<Parameter> known = vision::parameters_of(settable.recipes.stereo.options, method);
  for (const ParameterGroup& group : parameter_groups())
    for (Parameter& p : parameters_of(group, settable)) known.push_back(std::move(p));
  if (const auto set = set_parameters(arguments.stereo.parameters, known, "NAME"); !set) return set;
  recipes = std::move(settable.recipes);
  shapes = settable.shapes;
  return {};
}

/// Applies --size to every kind of scene.
Result<void> set_size(const std::string& text, session::Recipes& recipes) {
  if (text.empty()) return {};
  const auto size = size_from(text);
  if (!size) return size.error();
  recipes.relief.relief.size_m = *size;
  recipes.field.placement.size_m = *size;
  recipes.grid.size_m = *size;
  recipes.contours.map.width_m = size->x;
  recipes.contours.map.height_m = size->y;
  recipes.map.relief.width_m = size->x;
  recipes.map.relief.height_m = size->y;
  return {};
}

}  // namespace

Result<sculpt::ShapeSetOptions> shape_options(const MakeArguments& arguments,
                                              sculpt::ShapeSetOptions shapes) {
  const auto stereo = stereo_recipe(arguments);
  if (!stereo) return stereo.error();
  session::Recipes others;
  others.stereo = *stereo;
  if (const auto set = set_given(arguments, others, shapes); !set) return set.error();
  return shapes;
}

Result<session::MakeOptions> make_options(const MakeArguments& arguments) {
  session::MakeOptions options;
  options.made_by = kMadeBy;
  if (!arguments.no_cache) options.cache = {session::user_cache_folder(), session::user_cache_limit().bytes};
  options.as = make_as_from(arguments.as);
  auto input = input_options(arguments);
  if (!input) return input.error();
  options.input = *std::move(input);
  const auto field = field_recipe(arguments);
  if (!field) return field.error();
  const auto relief = relief_recipe(arguments);
  if (!relief) return relief.error();
  const auto stereo = stereo_recipe(arguments);
  if (!stereo) return stereo.error();
  options.recipes = {*stereo, *relief, contours_recipe(arguments), *field, {}, {}, {}, {}, {}};
  options.recipes.grid.occupancy.resolution = arguments.grid_points;
  if (arguments.grid_filling == "camera") options.recipes.grid.filling = recipes::GridFilling::from_camera;
  const auto video = video_recipe(arguments);
  if (!video) return video.error();
  options.recipes.video = *video;
  if (!arguments.map.gazetteer.empty()) {
    auto names = gazetteer_of(arguments.map.gazetteer);
    if (!names) return names.error();
    options.recipes.map.streets.names.gazetteer = *std::move(names);
  }
  options.recipes.sheet.thickness_m = arguments.sheet_mm / 1000.0;
  options.recipes.fusion.near_m = arguments.near.value_or(options.recipes.fusion.near_m);
  options.recipes.fusion.far_m = arguments.far.value_or(options.recipes.fusion.far_m);
  if (const auto sized = set_size(arguments.size, options.recipes); !sized) return sized.error();
  sculpt::ShapeSetOptions no_shapes;
  if (const auto set = set_given(arguments, options.recipes, no_shapes); !set) return set.error();
  return options;
}

std::optional<Note> note_on_cache(const MakeArguments& arguments) {
  return arguments.no_cache ? std::nullopt : session::user_cache_limit().note;
}

std::optional<Note> note_on_lay(const MakeArguments& arguments, const session::MakeOptions& options,
                                const models::Scene& made) {
  constexpr double kLow = 0.5;
  const Vec3 size = models::size_m(made);
  if (arguments.lay != "auto" || !models::is_upright_solid(made) || size.y >= kLow * std::min(size.x, size.z))
    return std::nullopt;
  const auto input = session::recognise(options.input);
  if (!input || input->kind == sources::InputKind::scene) return std::nullopt;
  return Note("The solid is wide and low and is seen from the front (--lay flat shows it from above).");
}

std::optional<Note> note_on_unused(const MakeArguments& arguments, const session::MakeOptions& options,
                                   const models::Scene& made) {
  const auto given = arguments.given ? arguments.given() : std::vector<std::string>{};
  // The input is recognised again only if it is needed.
  if (given.empty()) return std::nullopt;
  const auto input = session::recognise(options.input);
  if (!input) return std::nullopt;
  const UnusedParameters parameters =
      unused_parameters(arguments, options, input->kind, models::kind_of(made.model));
  std::string sentences;
  if (const auto words = unused_options(given, parameters.of_other_scenes, input->kind, made.model))
    sentences = *words;
  for (const std::string& sentence : parameters.sentences)
    sentences += (sentences.empty() ? "" : " ") + sentence;
  if (sentences.empty()) return std::nullopt;
  return Note(sentences);
}

Result<Vec3> size_from(const std::string& text) {
  const Error wrong{ErrorCode::usage,
                    fmt::format("'{}' is not a size: write WxHxD in mm, each 1 to 1000, as 100x75x20", text),
                    "--size"};
  std::array<double, 3> sides_mm{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < sides_mm.size(); ++i) {
    const std::size_t end = i + 1 == sides_mm.size() ? rest.size() : std::min(rest.find('x'), rest.size());
    const auto side = finite_number(rest.substr(0, end));
    if (!side || *side < 1.0 || *side > 1000.0) return wrong;
    sides_mm[i] = *side;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return Vec3{sides_mm[0] / 1000.0, sides_mm[1] / 1000.0, sides_mm[2] / 1000.0};
}

}  // namespace palpable::cli
