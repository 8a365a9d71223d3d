// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/sound_words.hpp"
#include "palpable/hearing/channel_faults.hpp"
#include "palpable/hearing/sound_tracks.hpp"
#include "palpable/sources/sound/microphones_file.hpp"
#include "palpable/sources/sound/wave_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ListenArguments {
  std::string recording, microphones;
  double window_s = hearing::ListenerOptions{}.window_s;
  double least_confidence = hearing::ListenerOptions{}.least_confidence;
};

/// What was heard in a recording.
struct Heard {
  double seconds = 0.0, rate_hz = 0.0;
  std::size_t channels = 0;
  hearing::ArrayShape shape = hearing::ArrayShape::spatial;
  std::vector<hearing::HeardSound> sounds;
  std::size_t windows = 0, windows_with_direction = 0;
};

Result<Heard> hear(hearing::Listener& listener, const Sound& sound, const Work& work) {
  const hearing::ArrayShape shape = listener.geometry().shape;
  Heard heard{sound.duration_s(), sound.rate_hz, sound.channels.size(), shape, {}, 0, 0};
  hearing::SoundTracks tracks(shape);
  const auto count = [&](const hearing::HeardWindow& window) {
    ++heard.windows;
    heard.windows_with_direction += window.direction ? 1 : 0;
    tracks.take(window);
  };
  // A second at a time, so that a long recording can be interrupted.
  const auto step = static_cast<std::size_t>(std::ceil(sound.rate_hz));
  for (std::size_t begin = 0; begin < sound.length(); begin += step) {
    if (work.cancelled()) return Work::interrupted();
    work.report(static_cast<double>(begin) / static_cast<double>(sound.length()), "Listening");
    Sound part{sound.rate_hz, {}};
    const std::size_t end = std::min(sound.length(), begin + step);
    for (const auto& channel : sound.channels)
      part.channels.emplace_back(channel.begin() + static_cast<std::ptrdiff_t>(begin),
                                 channel.begin() + static_cast<std::ptrdiff_t>(end));
    for (const auto& window : listener.take(part)) count(window);
  }
  if (const auto last = listener.finish()) count(*last);
  heard.sounds = tracks.take_ended(true);
  std::ranges::stable_sort(heard.sounds, {}, &hearing::HeardSound::begin_s);
  return heard;
}

Result<Heard> hear(const ListenArguments& arguments, const Work& work) {
  const auto microphones = sources::read_microphones(arguments.microphones);
  if (!microphones) return microphones.error();
  if (const auto geometry = hearing::geometry_of(*microphones); !geometry)
    return invalid_input(geometry.error().message, arguments.microphones);
  const auto sound = sources::read_wave(arguments.recording);
  if (!sound) return sound.error();
  if (sound->channels.size() != microphones->positions_m.size())
    return invalid_input(fmt::format("has {} channels, and the array {} microphones", sound->channels.size(),
                                     microphones->positions_m.size()),
                         arguments.recording);
  if (const auto valid = hearing::check_channels(*sound); !valid)
    return invalid_input(valid.error().message, arguments.recording);
  hearing::ListenerOptions options;
  options.window_s = arguments.window_s;
  options.least_confidence = arguments.least_confidence;
  auto listener = hearing::Listener::create(*microphones, sound->rate_hz, options);
  if (!listener) return invalid_input(listener.error().message, arguments.recording);
  return hear(*listener, *sound, work);
}

std::string_view name_of(hearing::ArrayShape shape) {
  switch (shape) {
    case hearing::ArrayShape::spatial:
      return "spatial";
    case hearing::ArrayShape::level:
      return "level";
    case hearing::ArrayShape::upright:
      break;
  }
  return "upright";
}

std::string angle_words(const hearing::Bearing& bearing) {
  std::string words = fmt::format("{:.0f} degrees {}", std::abs(bearing.azimuth_deg),
                                  bearing.azimuth_deg < 0.0 ? "left" : "right");
  if (bearing.elevation_deg)
    words += fmt::format(", {:.0f} {}", std::abs(*bearing.elevation_deg),
                         *bearing.elevation_deg < 0.0 ? "down" : "up");
  return words;
}

Json sound_json(const hearing::HeardSound& sound) {
  const auto& bearing = sound.bearing;
  return {{"time_s", sound.begin_s},
          {"until_s", sound.end_s},
          {"azimuth_deg", bearing.azimuth_deg},
          {"elevation_deg", bearing.elevation_deg ? Json(*bearing.elevation_deg) : Json(nullptr)},
          {"confidence", sound.confidence},
          {"snr_db", sound.snr_db},
          {"words", describe::sound_words(bearing.azimuth_deg, bearing.elevation_deg)}};
}

Result<Answer> listen(const ListenArguments& arguments, Console& console) {
  const auto heard = hear(arguments, console.work());
  if (!heard) return heard.error();
  Answer answer;
  answer.json = {{"seconds", heard->seconds},   {"rate_hz", heard->rate_hz},
                 {"channels", heard->channels}, {"array", name_of(heard->shape)},
                 {"windows", heard->windows},   {"windows_with_direction", heard->windows_with_direction},
                 {"sounds", Json::array()}};
  answer.text = fmt::format(
      "{}: {:.1f} s, {} channels at {:.0f} Hz; {}.\n", arguments.recording, heard->seconds, heard->channels,
      heard->rate_hz,
      describe::counted(heard->sounds.size(), "sound with a direction", "sounds with a direction"));
  for (const auto& sound : heard->sounds) {
    answer.json["sounds"].push_back(sound_json(sound));
    answer.text += fmt::format("{:6.2f} to {:6.2f} s: {} ({}), confidence {:.2f}, SNR {:.0f} dB\n",
                               sound.begin_s, sound.end_s,
                               describe::sound_words(sound.bearing.azimuth_deg, sound.bearing.elevation_deg),
                               angle_words(sound.bearing), sound.confidence, sound.snr_db);
  }
  if (heard->shape == hearing::ArrayShape::upright && !heard->sounds.empty())
    answer.text +=
        "The microphones are in one plane: each sound may also be at the mirror place behind it.\n";
  return answer;
}

}  // namespace

void add_listen(Program& program) {
  const auto arguments = std::make_shared<ListenArguments>();
  Options options =
      add_command(program, "listen", "The direction of the sounds in a recording of several microphones",
                  "  palpable listen room.wav --microphones array.json\n"
                  "  palpable listen room.wav --microphones array.json --json",
                  [arguments](Console& console) { return listen(*arguments, console); });
  options.argument("RECORDING", arguments->recording, "A WAV file with one channel for each microphone");
  options.required_text("--microphones", arguments->microphones,
                        "Where the microphones are: a JSON file, as {\"microphones_m\": [[x, y, z], …]}");
  options.number("--window", arguments->window_s, {0.1, 10.0},
                 "A direction is found in this time, s, and anew after each half of it");
  options.number("--least-confidence", arguments->least_confidence, {0.0, 1.0},
                 "Below this there is no direction");
}

}  // namespace palpable::cli
