// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/sources/calibration/json_camera.hpp"
#include "palpable/sources/depth/depth_picture.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace palpable::sources {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<DepthMeaning, std::string_view>, 5> kNames{
    {{DepthMeaning::depth, "depth"},
     {DepthMeaning::distance, "distance"},
     {DepthMeaning::disparity, "disparity"},
     {DepthMeaning::nearness, "nearness"},
     {DepthMeaning::zbuffer, "zbuffer"}}};

/// True if `key` has the value `word`, false if it has `otherwise` or is missing. Errors: for any other
/// value.
Result<bool> choice(const json& object, const char* key, std::string_view word, std::string_view otherwise) {
  if (!object.contains(key)) return false;
  const json& value = object.at(key);
  if (value == word) return true;
  if (value == otherwise) return false;
  return invalid_input(std::string(key) + " is neither '" + std::string(word) + "' nor '" +
                       std::string(otherwise) + "'");
}

Result<std::optional<ZBuffer>> zbuffer_in(const json& object) {
  if (!object.contains("near_m")) return std::optional<ZBuffer>();
  ZBuffer buffer;
  const auto near = number_in(object, "near_m");
  if (!near) return invalid_input("near_m is not a number");
  buffer.near_m = *near;
  buffer.far_m = number_in(object, "far_m").value_or(std::numeric_limits<double>::infinity());
  const auto signed_range = choice(object, "range", "-1..1", "0..1");
  if (!signed_range) return signed_range.error();
  const auto reversed = choice(object, "order", "near_is_large", "near_is_small");
  if (!reversed) return reversed.error();
  const auto flat = choice(object, "projection", "orthographic", "perspective");
  if (!flat) return flat.error();
  const auto solid = choice(object, "far_plane", "is_a_surface", "is_empty");
  if (!solid) return solid.error();
  if (*signed_range) buffer.range = ZBuffer::Range::minus_one_to_one;
  if (*reversed) buffer.order = ZBuffer::Order::near_is_large;
  if (*flat) buffer.projection = ZBuffer::Projection::orthographic;
  if (*solid) buffer.far_plane = ZBuffer::FarPlane::is_a_surface;
  return std::optional(buffer);
}

template <std::size_t Count>
std::optional<std::array<double, Count>> numbers_in(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != Count) return std::nullopt;
  std::array<double, Count> out{};
  for (std::size_t i = 0; i < Count; ++i) {
    if (!(*found)[i].is_number()) return std::nullopt;
    out[i] = (*found)[i].template get<double>();
  }
  return out;
}

Result<ColourCamera> colour_camera_from(const json& object) {
  if (!object.is_object()) return invalid_input("states a colour camera that is not an object");
  const auto camera = pinhole_from(object);
  if (!camera) return invalid_input("its colour camera " + camera.error().message);
  ColourCamera out;
  out.camera = *camera;
  if (object.contains("rotation")) {
    const auto rotation = numbers_in<9>(object, "rotation");
    if (!rotation) return invalid_input("states a rotation that is not 9 numbers");
    out.rotation = *rotation;
  }
  if (object.contains("translation_m")) {
    const auto move = numbers_in<3>(object, "translation_m");
    if (!move) return invalid_input("states a translation_m that is not 3 numbers");
    out.translation_m = {(*move)[0], (*move)[1], (*move)[2]};
  }
  return out;
}

Result<std::optional<double>> scale_in(const json& object, const char* key) {
  if (!object.contains(key)) return std::optional<double>();
  const auto value = number_in(object, key);
  if (!value || !(*value > 0.0) || !std::isfinite(*value))
    return invalid_input(std::string(key) + " is not a positive number");
  return value;
}

}  // namespace

std::string_view name_of(DepthMeaning meaning) { return kNames[static_cast<std::size_t>(meaning)].second; }

std::optional<DepthMeaning> depth_meaning_from(std::string_view name) {
  for (const auto& [meaning, known] : kNames)
    if (name == known) return meaning;
  return std::nullopt;
}

DepthSettings merged(DepthSettings first, const DepthSettings& otherwise) {
  const auto fill = [](auto& mine, const auto& other) {
    if (!mine) mine = other;
  };
  fill(first.meaning, otherwise.meaning);
  fill(first.metres_per_unit, otherwise.metres_per_unit);
  fill(first.px_per_unit, otherwise.px_per_unit);
  fill(first.zbuffer, otherwise.zbuffer);
  fill(first.camera, otherwise.camera);
  fill(first.colour, otherwise.colour);
  return first;
}

Result<DepthSettings> decode_depth_settings(std::string_view text) {
  const json object = json::parse(text, nullptr, false);
  if (!object.is_object()) return invalid_input("is not valid JSON");
  DepthSettings out;
  if (object.contains("meaning")) {
    const json& name = object.at("meaning");
    out.meaning = name.is_string() ? depth_meaning_from(name.get<std::string>()) : std::nullopt;
    if (!out.meaning)
      return invalid_input("states a meaning that is none of depth, distance, disparity, nearness, zbuffer");
  }
  auto metres = scale_in(object, "metres_per_unit");
  if (!metres) return std::move(metres).error();
  const auto scale = scale_in(object, "scale");
  if (!scale) return scale.error();
  // Some cameras state the metres of a unit, others the units of a metre.
  if (*scale && !*metres) *metres = **scale > 1.0 ? 1.0 / **scale : **scale;
  auto pixels = scale_in(object, "px_per_unit");
  if (!pixels) return std::move(pixels).error();
  auto buffer = zbuffer_in(object);
  if (!buffer) return std::move(buffer).error();
  out.metres_per_unit = *metres;
  out.px_per_unit = *pixels;
  out.zbuffer = *buffer;
  if (object.contains("fx")) {
    const auto camera = pinhole_from(object);
    if (!camera) return camera.error();
    out.camera = *camera;
  }
  if (object.contains("colour")) {
    const auto colour = colour_camera_from(object.at("colour"));
    if (!colour) return colour.error();
    out.colour = *colour;
  }
  return out;
}

std::vector<std::filesystem::path> depth_sidecars_of(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  fs::path own = file;
  own += ".json";
  std::vector<fs::path> sidecars{own, fs::path(file).replace_extension(".json"),
                                 file.parent_path() / "depth.json"};
  std::erase(sidecars, file);
  return sidecars;
}

Result<DepthSettings> read_depth_sidecar(const std::filesystem::path& file) {
  for (const std::filesystem::path& path : depth_sidecars_of(file)) {
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown)) continue;
    constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 20U;
    const auto text = read_file(path, kMaxBytes);
    if (!text) return text.error();
    auto settings = decode_depth_settings(as_text(*text));
    if (!settings) settings.error().place = path.string();
    return settings;
  }
  return DepthSettings{};
}

}  // namespace palpable::sources
