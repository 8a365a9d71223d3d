// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/sound_scene.hpp"

#include "palpable/hearing/array_shape.hpp"
#include "palpable/hearing/spectrum.hpp"
#include "palpable/study/world/room_view.hpp"
#include "palpable/study/world/sound_random.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

namespace palpable::study {
namespace {

double mean_square(const std::vector<float>& samples, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += double{samples[i]} * double{samples[i]};
  return sum / static_cast<double>(end - begin);
}

using Channels = std::vector<std::vector<float>>;

double mean_square(const Channels& channels, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (const auto& channel : channels) sum += mean_square(channel, begin, end);
  return sum / static_cast<double>(channels.size());
}

Channels channel_noise(std::size_t channels, std::size_t length, SoundRandom& random) {
  Channels out(channels, std::vector<float>(length));
  for (auto& channel : out)
    for (float& sample : channel) sample = static_cast<float>(random.normal());
  return out;
}

/// Far sources around the array, each delayed for each microphone by the phase of its spectrum.
Channels noise_from_everywhere(const SoundSceneOptions& options, std::size_t length, SoundRandom& random) {
  constexpr int kSources = 64;
  const std::size_t size = std::bit_ceil(length);
  const auto& microphones = options.microphones;
  std::vector<hearing::Spectrum> sums(microphones.positions_m.size(), hearing::Spectrum(size / 2 + 1));
  for (int source = 0; source < kSources; ++source) {
    const double up = random.between(-1.0, 1.0), turn = random.between(0.0, 2.0 * std::numbers::pi);
    const double level = std::sqrt(1.0 - up * up);
    const Vec3 towards{level * std::cos(turn), up, level * std::sin(turn)};
    const hearing::Spectrum own = hearing::spectrum_of(falling_noise(size, random));
    for (std::size_t m = 0; m < sums.size(); ++m) {
      const double late_s = -dot(towards, microphones.positions_m[m].v) / microphones.speed_of_sound_m_per_s;
      const double turn_per_bin =
          -2.0 * std::numbers::pi * options.rate_hz / static_cast<double>(size) * late_s;
      for (std::size_t bin = 0; bin < own.size(); ++bin) {
        const double phase = turn_per_bin * static_cast<double>(bin);
        sums[m][bin] += own[bin] * std::complex<float>(static_cast<float>(std::cos(phase)),
                                                       static_cast<float>(std::sin(phase)));
      }
    }
  }
  Channels out;
  for (const auto& sum : sums) {
    out.push_back(hearing::samples_of(sum));
    out.back().resize(length);
  }
  return out;
}

/// Where array and sound are.
struct Places {
  Point<WorldFrame> array, source;
  double heading_rad = 0.0;
};

Places places_in(const Vec3& size_m, SoundRandom& random) {
  constexpr double kFromWalls_m = 0.5, kNearest_m = 0.8, kFarthest_m = 3.5;
  const auto place = [&](double from_walls_m, double low_m, double high_m) {
    const double x = 0.5 * size_m.x - from_walls_m, y = 0.5 * size_m.y - from_walls_m;
    return Point<WorldFrame>{{random.between(-x, x), random.between(-y, y), random.between(low_m, high_m)}};
  };
  Places out;
  out.array = place(kFromWalls_m, 0.6, 1.1);
  out.heading_rad = random.between(-std::numbers::pi, std::numbers::pi);
  double distance_m = 0.0;
  do {
    out.source = place(0.3, 0.3, 1.9);
    distance_m = norm(out.source.v - out.array.v);
  } while (distance_m < kNearest_m || distance_m > kFarthest_m);
  return out;
}

/// What each microphone hears of the sound.
Channels heard_at(const SoundScene& scene, const SoundSceneOptions& options, const Places& places,
                  const std::vector<float>& dry, std::size_t length) {
  const auto world_from_array = camera_pose(places.array, places.heading_rad, 0.0);
  const double echo_s = std::max(options.reverberation_s, scene.distance_m / 100.0);
  Channels out;
  for (const auto& at : options.microphones.positions_m) {
    const std::vector<float> response =
        impulse_response(scene.room, places.source, world_from_array * at, options.rate_hz, echo_s);
    const std::vector<float> wet = hearing::convolved(dry, response);
    auto& channel = out.emplace_back(length);
    const auto begin = static_cast<std::size_t>(scene.begin_s * options.rate_hz);
    for (std::size_t i = kEchoLead; i < wet.size() && begin + i - kEchoLead < length; ++i)
      channel[begin + i - kEchoLead] = wet[i];
  }
  return out;
}

}  // namespace

Microphones tetrahedral_array(double radius_m) {
  const double side = radius_m / std::numbers::sqrt3;
  return {{{{-side, -side, -side}}, {{side, -side, side}}, {{side, side, -side}}, {{-side, side, side}}}};
}

SoundScene make_sound_scene(std::uint64_t seed, const SoundSceneOptions& options) {
  SoundRandom random(seed);
  SoundScene scene;
  scene.room.size_m = {random.between(4.0, 8.0), random.between(3.5, 6.0), random.between(2.4, 3.2)};
  scene.room.speed_of_sound_m_per_s = options.microphones.speed_of_sound_m_per_s;
  const Places places = places_in(scene.room.size_m, random);
  const auto kind = static_cast<TestSound>(random.below(3));
  const auto length =
      static_cast<std::size_t>((options.lead_s + options.sound_s + options.tail_s) * options.rate_hz);
  scene.sound.rate_hz = options.rate_hz;
  const auto microphones = options.microphones.positions_m.size();
  Channels noise = options.background == Background::of_channels
                       ? channel_noise(microphones, length, random)
                       : noise_from_everywhere(options, length, random);
  // 40 dB below full scale.
  constexpr double kSound = 0.01;
  const double noise_level = kSound * std::pow(10.0, -0.05 * options.snr_db);
  const double noise_gain = noise_level / std::sqrt(mean_square(noise, 0, length));
  for (auto& channel : noise)
    for (float& sample : channel) sample *= static_cast<float>(noise_gain);
  scene.sound.channels = std::move(noise);
  if (!options.has_sound) return scene;
  scene.begin_s = options.lead_s;
  scene.end_s = options.lead_s + options.sound_s;
  scene.distance_m = norm(places.source.v - places.array.v);
  if (options.reverberation_s > 0.0)
    scene.room.reflection = reflection_for(scene.room, places.source, places.array, options.reverberation_s);
  const std::vector<float> dry = test_sound(kind, options.rate_hz, options.sound_s, seed);
  const Channels heard = heard_at(scene, options, places, dry, length);
  const double level = std::sqrt(mean_square(heard, static_cast<std::size_t>(scene.begin_s * options.rate_hz),
                                             static_cast<std::size_t>(scene.end_s * options.rate_hz)));
  for (std::size_t m = 0; m < microphones; ++m)
    for (std::size_t i = 0; i < length; ++i)
      scene.sound.channels[m][i] += static_cast<float>(kSound / level) * heard[m][i];
  const auto array_from_world = camera_pose(places.array, places.heading_rad, 0.0).inverse();
  const Point<CameraFrame> seen = array_from_world * places.source;
  const auto bearing = hearing::bearing_of({seen.v}, hearing::ArrayShape::spatial);
  scene.azimuth_deg = bearing.azimuth_deg;
  scene.elevation_deg = bearing.elevation_deg;
  return scene;
}

}  // namespace palpable::study
