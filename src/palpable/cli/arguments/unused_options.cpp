// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/unused_options.hpp"

#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

using sources::InputKind;

using Inputs = std::vector<InputKind>;

/// The inputs and scenes on which an option has an effect; an empty list means all.
struct Effect {
  std::string_view option;
  Inputs inputs;
  /// As models::kind_of().
  std::vector<std::string_view> scenes;
};

const std::vector<Effect>& effects() {
  static const Inputs any{}, depth{InputKind::depth}, pair{InputKind::stereo},
      seen{InputKind::stereo, InputKind::depth}, video{InputKind::video},
      posed{InputKind::depth, InputKind::video},
      with_camera{InputKind::stereo, InputKind::depth, InputKind::video},
      solid{InputKind::mesh, InputKind::points, InputKind::shapes, InputKind::level_set};
  static const Inputs measured{InputKind::stereo, InputKind::depth,     InputKind::mesh, InputKind::points,
                               InputKind::video,  InputKind::level_set, InputKind::scene};
  static const Inputs made{InputKind::picture,   InputKind::stereo, InputKind::depth,
                           InputKind::mesh,      InputKind::points, InputKind::shapes,
                           InputKind::level_set, InputKind::video,  InputKind::map};
  static const std::vector<std::string_view> all{}, contours{"contours"}, fields{"field", "dense-field"};
  static const std::vector<Effect> table{{"--size", made, all},
                                         {"--depth-scale", depth, all},
                                         {"--depth-as", depth, all},
                                         {"--near-plane", depth, all},
                                         {"--far-plane", depth, all},
                                         {"--poses", posed, all},
                                         {"--near", seen, all},
                                         {"--far", seen, all},
                                         {"--exaggerate", seen, all},
                                         {"--detail", seen, all},
                                         {"--compression", seen, all},
                                         {"--smooth", seen, all},
                                         {"--resample", seen, all},
                                         {"--samples", seen, all},
                                         {"--engrave", seen, all},
                                         {"--texture", seen, all},
                                         {"--calibration", with_camera, all},
                                         {"--structure", video, all},
                                         {"--depth-dir", video, all},
                                         {"--report", video, all},
                                         {"--mesh", video, all},
                                         {"--length", video, all},
                                         {"--until", video, all},
                                         {"--surface", measured, fields},
                                         {"--motion", video, all},
                                         {"--method", pair, all},
                                         {"--max-disparity", pair, all},
                                         {"--rectify", pair, all},
                                         {"--moved", pair, all},
                                         {"--megapixels", pair, all},
                                         {"--center", {InputKind::map}, all},
                                         {"--width", {InputKind::map}, all},
                                         {"--layers", {InputKind::map}, all},
                                         {"--gazetteer", {InputKind::picture}, {"relief"}},
                                         {"--up", solid, all},
                                         {"--lay", solid, all},
                                         {"--sheet", {InputKind::mesh}, {"relief"}},
                                         {"--resolution", any, fields},
                                         {"--max-error", any, {"field"}},
                                         {"--grid-points", any, {"grid"}},
                                         {"--contour-method", any, contours},
                                         {"--quality", any, contours},
                                         {"--threshold", any, contours},
                                         {"--neighbourhood", any, contours},
                                         {"--groove", any, contours}};
  return table;
}

/// True if `list` contains `value` or is empty.
template <class T>
bool is_among(const T& value, const std::vector<T>& list) {
  return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
}

std::string with_article(const std::string& kind) {
  const bool many = kind == "contours" || kind == "points" || kind == "shapes" || kind == "depth";
  return many ? kind : "a " + kind;
}

/// "--size and --lay have".
std::string listed_with_verb(const std::vector<std::string>& unused) {
  return describe::listed(unused) + (unused.size() == 1 ? " has" : " have");
}

}  // namespace

std::optional<std::string> unused_by_fit_shapes(std::span<const std::string> given) {
  // Of an input and of a pair's depth.
  constexpr std::array<std::string_view, 10> kUsed{
      "--depth-scale", "--depth-as",      "--near-plane", "--far-plane", "--calibration",
      "--method",      "--max-disparity", "--rectify",    "--moved",     "--megapixels"};
  const auto is_unused = [&](const std::string& option) {
    const auto is_it = [&](const Effect& effect) { return effect.option == option; };
    return option == "--as" || (std::any_of(effects().begin(), effects().end(), is_it) &&
                                std::find(kUsed.begin(), kUsed.end(), option) == kUsed.end());
  };
  std::vector<std::string> unused;
  std::copy_if(given.begin(), given.end(), std::back_inserter(unused), is_unused);
  if (unused.empty()) return std::nullopt;
  return listed_with_verb(unused) + " no effect on fitted shapes, which are no scene yet.";
}

std::optional<std::string> unused_options(std::span<const std::string> given,
                                          std::span<const std::string> parameters, InputKind input,
                                          const models::Model& made) {
  const std::string scene = models::kind_of(made);
  std::vector<std::string> unused;
  for (const Effect& effect : effects()) {
    const bool fits = is_among(input, effect.inputs) && is_among(std::string_view(scene), effect.scenes);
    if (!fits && std::find(given.begin(), given.end(), effect.option) != given.end())
      unused.emplace_back(effect.option);
  }
  unused.insert(unused.end(), parameters.begin(), parameters.end());
  if (unused.empty()) return std::nullopt;
  const std::string input_words =
      input == InputKind::stereo ? "a pair" : with_article(std::string(name_of(input)));
  return fmt::format("{} no effect on {} made from {}.", listed_with_verb(unused), with_article(scene),
                     input_words);
}

}  // namespace palpable::cli
