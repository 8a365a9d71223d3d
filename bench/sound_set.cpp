// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The direction of sounds in rooms made from seeds, beside the truth: palpable_sound_set [FIRST LAST
// [ARRAY]]. Each scene is heard by three arrays, or the one of that number: a square of radius 0.1 m (0), one
// of 0.032 m (1), and a tetrahedron of 0.1 m (2). Errors are in degrees; those of sounds and windows at the
// program's least confidence.
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/hearing/sound_tracks.hpp"
#include "palpable/study/world/sound_scene.hpp"

#include <algorithm>
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
const double kLeastConfidence = hearing::ListenerOptions{}.least_confidence;

/// Over the scenes of one condition.
struct Tally {
  int scenes = 0, heard = 0;
  /// Of the longest sound in a scene, and of single windows; by sector.
  std::vector<double> azimuth_errors, elevation_errors, window_errors, snr_errors;
  std::array<std::vector<double>, kSectors> by_sector;
  /// Windows within a sound, and those that touch none.
  int sound_windows = 0, silent_windows = 0;
  /// Confidences of those that have a direction at the least confidence of 0: of the sound's (within 10
  /// degrees of it), of another, and where there is none.
  std::vector<double> right, wrong, without;
};

double quantile(std::vector<double> values, double at) { return quantile_of(values, at); }

double azimuth_error(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

void add_window(Tally& tally, const study::SoundScene& scene, const hearing::HeardWindow& window,
                hearing::ArrayShape shape) {
  // The tail of a sound in a room is neither sound nor silence.
  const bool is_silent =
      !scene.azimuth_deg || window.end_s < scene.begin_s || window.begin_s > scene.end_s + 0.3;
  const bool is_sound = scene.azimuth_deg && window.begin_s >= scene.begin_s && window.end_s <= scene.end_s;
  tally.silent_windows += is_silent ? 1 : 0;
  tally.sound_windows += is_sound ? 1 : 0;
  if (!window.direction) return;
  if (is_silent) tally.without.push_back(window.confidence);
  if (!is_sound) return;
  constexpr double kRight_deg = 10.0;
  const double error =
      azimuth_error(hearing::bearing_of(*window.direction, shape).azimuth_deg, *scene.azimuth_deg);
  (error <= kRight_deg ? tally.right : tally.wrong).push_back(window.confidence);
  if (window.confidence >= kLeastConfidence) tally.window_errors.push_back(error);
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
  hearing::ListenerOptions all;
  all.least_confidence = 0.0;
  auto listener = hearing::Listener::create(options.microphones, options.rate_hz, all);
  if (!listener) return;
  const hearing::ArrayShape shape = listener->geometry().shape;
  hearing::SoundTracks tracks(shape);
  for (auto window : listener->take(scene.sound)) {
    add_window(tally, scene, window, shape);
    if (window.confidence < kLeastConfidence) window.direction.reset();
    tracks.take(window);
  }
  add_sounds(tally, scene, tracks.take_ended(true));
}

std::string quantiles(const std::vector<double>& values) {
  if (values.empty()) return "   -      -  ";
  return fmt::format("{:5.1f} {:6.1f}", quantile(values, 0.5), quantile(values, 0.9));
}

/// Shares of windows in percent at a least confidence: right and wrong directions in a sound, and directions
/// where there is none.
std::string shares_at(const Tally& tally, double least) {
  const auto share = [least](const std::vector<double>& confidences, int of) {
    const auto count = std::ranges::count_if(confidences, [least](double c) { return c >= least; });
    return of > 0 ? 100.0 * static_cast<double>(count) / of : 0.0;
  };
  return fmt::format("{:.2f}: {:3.0f} {:3.0f} {:4.1f}", least, share(tally.right, tally.sound_windows),
                     share(tally.wrong, tally.sound_windows), share(tally.without, tally.silent_windows));
}

void print(const char* array, const char* condition, const Tally& tally) {
  fmt::print("{:12} {:24} heard {:3}/{:3} | azimuth 50, 90 % {} | elevation {} | windows {}\n", array,
             condition, tally.heard, tally.scenes, quantiles(tally.azimuth_errors),
             quantiles(tally.elevation_errors), quantiles(tally.window_errors));
  fmt::print("    by sector:");
  for (int sector = 0; sector < kSectors; ++sector)
    fmt::print(" | {:4.0f} {}", sector * 360.0 / kSectors - 180.0,
               quantiles(tally.by_sector[static_cast<std::size_t>(sector)]));
  fmt::print("\n    right, wrong, false %:");
  for (const double least : {0.06, 0.08, 0.10, 0.12, 0.15}) fmt::print(" | {}", shares_at(tally, least));
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
  const auto only = whole_number(count > 3 ? words[3] : "-1");
  if (!first || !last || !only || *first < 0 || *last < *first) {
    fmt::print(stderr, "palpable_sound_set [FIRST LAST [ARRAY]]\n");
    return 2;
  }
  const std::array<Array, 3> arrays{{{"square 0.1", square_array(0.1)},
                                     {"square 0.032", square_array(0.032)},
                                     {"tetra 0.1", study::tetrahedral_array(0.1)}}};
  for (std::size_t n = 0; n < arrays.size(); ++n)
    for (Condition condition : conditions()) {
      if (*only >= 0 && static_cast<std::size_t>(*only) != n) continue;
      const Array& array = arrays[n];
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
