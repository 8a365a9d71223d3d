// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/sound/microphones_file.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace palpable::sources {
namespace {

std::optional<Vec3> place_from(const nlohmann::json& json) {
  if (!json.is_array() || json.size() != 3) return std::nullopt;
  for (const auto& number : json)
    if (!number.is_number()) return std::nullopt;
  const Vec3 place{json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  return is_finite(place) ? std::optional(place) : std::nullopt;
}

}  // namespace

Result<Microphones> decode_microphones(std::string_view text) {
  constexpr std::size_t kMost = 64;
  const nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object()) return invalid_input("is not valid JSON of an array of microphones");
  for (const auto& member : object.items())
    if (member.key() != "microphones_m" && member.key() != "frame" &&
        member.key() != "speed_of_sound_m_per_s")
      return invalid_input("states \"" + plain_name(member.key()) +
                           "\", which is none of microphones_m, frame, speed_of_sound_m_per_s");
  const auto places = object.find("microphones_m");
  if (places == object.end() || !places->is_array() || places->empty() || places->size() > kMost)
    return invalid_input("lacks microphones_m, a list of 1 to 64 places");
  const nlohmann::json frame = object.value("frame", nlohmann::json("camera"));
  const bool is_robot = frame == "robot";
  if (!is_robot && frame != "camera") return invalid_input("states a frame that is neither camera nor robot");
  Microphones out;
  for (const auto& entry : *places) {
    const auto place = place_from(entry);
    if (!place) return invalid_input("states a microphone that is not three numbers, in metres");
    out.positions_m.push_back({is_robot ? Vec3{-place->y, -place->z, place->x} : *place});
  }
  if (const auto speed = object.find("speed_of_sound_m_per_s"); speed != object.end()) {
    if (!speed->is_number()) return invalid_input("states a speed of sound that is not a number");
    out.speed_of_sound_m_per_s = speed->get<double>();
  }
  return out;
}

Result<Microphones> read_microphones(const std::filesystem::path& path) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20U;
  const auto text = read_text_file(path, kMostBytes);
  if (!text) return text.error();
  auto microphones = decode_microphones(*text);
  if (!microphones) microphones.error().place = path.string();
  return microphones;
}

}  // namespace palpable::sources
