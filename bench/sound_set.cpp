// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The direction of sounds in rooms made from seeds, beside the truth: palpable_sound_set [FIRST LAST]. Each
// scene is heard by three arrays: a square of radius 0.1 m, one of 0.032 m, and a tetrahedron of 0.1 m.
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/hearing/sound_tracks.hpp"
#include "palpable/study/world/sound_scene.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

struct Condition {
  const char* name;
  study::SoundSceneOptions scene;
};

struct Array {
  const char* name;
  Microphones microphones;
};

constexpr int kSectors = 8;

/// Over the scenes of one condition.
struct Tally {
  int scenes = 0, heard = 0;
  /// Of the longest sound in a scene, and of single windows; by sector.
  std::vector<double> azimuth_errors, elevation_errors, window_errors, snr_errors;
  std::array<std::vector<double>, kSectors> by_sector;
  /// Windows that touch no sound, and those of them with a direction.
  int silent_windows = 0, false_windows = 0, sound_windows = 0, sound_directions = 0;
  std::vector<double> right_confidence, wrong_confidence, silent_confidence;
};

double quantile(std::vector<double> values, double at) { return quantile_of(values, at); }

double azimuth_error(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

void add_window(Tally& tally, const study::SoundScene& scene, const hearing::HeardWindow& window,
                hearing::ArrayShape shape) {
  // The tail of a sound in a room is neither sound nor silence.
  const bool is_silent =
      !scene.azimuth_deg || window.end_s < scene.begin_s || window.begin_s > scene.end_s + 0.3;
  const bool is_sound = scene.azimuth_deg && window.begin_s >= scene.begin_s && window.end_s <= scene.end_s;
  if (is_silent) {
    ++tally.silent_windows;
    tally.false_windows += window.direction ? 1 : 0;
    tally.silent_confidence.push_back(window.confidence);
  }
  if (!is_sound) return;
  ++tally.sound_windows;
  if (!window.direction) return;
  ++tally.sound_directions;
  const double error =
      azimuth_error(hearing::bearing_of(*window.direction, shape).azimuth_deg, *scene.azimuth_deg);
  tally.window_errors.push_back(error);
  (error < 10.0 ? tally.right_confidence : tally.wrong_confidence).push_back(window.confidence);
}

void add_sounds(Tally& tally, const study::SoundScene& scene,
                const std::vector<hearing::HeardSound>& sounds) {
  ++tally.scenes;
  if (!scene.azimuth_deg) return;
  const hearing::HeardSound* longest = nullptr;
  for (const auto& sound : sounds)
    if (longest == nullptr || sound.end_s - sound.begin_s > longest->end_s - longest->begin_s)
      longest = &sound;
  if (longest == nullptr) return;
  ++tally.heard;
  const double error = azimuth_error(longest->bearing.azimuth_deg, *scene.azimuth_deg);
  tally.azimuth_errors.push_back(error);
  const int sector =
      static_cast<int>(std::floor((*scene.azimuth_deg + 180.0) / (360.0 / kSectors))) % kSectors;
  tally.by_sector[static_cast<std::size_t>(sector)].push_back(error);
  if (longest->bearing.elevation_deg)
    tally.elevation_errors.push_back(std::abs(*longest->bearing.elevation_deg - *scene.elevation_deg));
}

void listen(Tally& tally, std::uint64_t seed, const study::SoundSceneOptions& options) {
  const study::SoundScene scene = study::make_sound_scene(seed, options);
  auto listener = hearing::Listener::create(options.microphones, options.rate_hz);
  if (!listener) return;
  const hearing::ArrayShape shape = listener->geometry().shape;
  hearing::SoundTracks tracks(shape);
  for (const auto& window : listener->take(scene.sound)) {
    add_window(tally, scene, window, shape);
    tracks.take(window);
  }
  add_sounds(tally, scene, tracks.take_ended(true));
}

std::string quantiles(const std::vector<double>& values) {
  if (values.empty()) return "   -      -  ";
  return fmt::format("{:5.1f} {:6.1f}", quantile(values, 0.5), quantile(values, 0.9));
}

void print(const char* array, const char* condition, const Tally& tally) {
  fmt::print(
      "{:12} {:26} heard {:3}/{:3} | azimuth 50, 90 % {} | elevation {} | windows {} of {:4}/{:4} | false "
      "{}/{}",
      array, condition, tally.heard, tally.scenes, quantiles(tally.azimuth_errors),
      quantiles(tally.elevation_errors), quantiles(tally.window_errors), tally.sound_directions,
      tally.sound_windows, tally.false_windows, tally.silent_windows);
  const auto level = [](const std::vector<double>& values, double part) {
    return values.empty() ? 0.0 : quantile(values, part);
  };
  fmt::print(" | confidence right 10 % {:.3f}, wrong 90 % {:.3f}, silent 99 % {:.3f}\n   by sector:",
             level(tally.right_confidence, 0.1), level(tally.wrong_confidence, 0.9),
             level(tally.silent_confidence, 0.99));
  for (int sector = 0; sector < kSectors; ++sector)
    fmt::print(" {:4.0f}: {}", sector * 360.0 / kSectors - 180.0,
               quantiles(tally.by_sector[static_cast<std::size_t>(sector)]));
  fmt::print("\n");
  std::fflush(stdout);
}

std::vector<Condition> conditions() {
  const auto of = [](double reverberation_s, double snr_db, study::Background background) {
    study::SoundSceneOptions options;
    options.reverberation_s = reverberation_s;
    options.snr_db = snr_db;
    options.background = background;
    return options;
  };
  using study::Background;
  std::vector<Condition> out{
      {"free, 10 dB", of(0.0, 10.0, Background::of_channels)},
      {"free, 10 dB everywhere", of(0.0, 10.0, Background::from_everywhere)},
      {"free, 0 dB", of(0.0, 0.0, Background::of_channels)},
      {"0.5 s, 30 dB", of(0.5, 30.0, Background::of_channels)},
      {"0.5 s, 10 dB", of(0.5, 10.0, Background::of_channels)},
      {"0.5 s, 10 dB everywhere", of(0.5, 10.0, Background::from_everywhere)},
      {"channel noise alone", of(0.0, 10.0, Background::of_channels)},
      {"noise everywhere alone", of(0.0, 10.0, Background::from_everywhere)},
  };
  for (std::size_t n = out.size() - 2; n < out.size(); ++n) out[n].scene.has_sound = false;
  return out;
}

int run(int count, const char* const* words) {
  const auto first = whole_number(count > 1 ? words[1] : "1"),
             last = whole_number(count > 2 ? words[2] : "100");
  if (!first || !last || *first < 0 || *last < *first) {
    fmt::print(stderr, "palpable_sound_set [FIRST LAST]\n");
    return 2;
  }
  const std::array<Array, 3> arrays{{{"square 0.1", study::square_array(0.1)},
                                     {"square 0.032", study::square_array(0.032)},
                                     {"tetra 0.1", study::tetrahedral_array(0.1)}}};
  for (const Array& array : arrays)
    for (Condition condition : conditions()) {
      condition.scene.microphones = array.microphones;
      Tally tally;
      for (auto seed = static_cast<std::uint64_t>(*first); seed <= static_cast<std::uint64_t>(*last); ++seed)
        listen(tally, seed, condition.scene);
      print(array.name, condition.name, tally);
    }
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
