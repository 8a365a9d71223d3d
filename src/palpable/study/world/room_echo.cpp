// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/room_echo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace palpable::study {
namespace {

/// The sound from an image: its way, and how often it was reflected.
struct Image {
  double way_m = 0.0;
  int reflections = 0;
};

/// The distances along one axis, of the images within `most_m`.
std::vector<Image> images_along(double size_m, double from_m, double to_m, double most_m) {
  std::vector<Image> images;
  // Measured from one wall: images at 2 n size + from, reflected 2 |n| times, and at 2 n size - from,
  // |2 n - 1| times.
  const double from = from_m + 0.5 * size_m, to = to_m + 0.5 * size_m;
  const int most = static_cast<int>(std::ceil(most_m / (2.0 * size_m))) + 1;
  for (int n = -most; n <= most; ++n) {
    images.push_back({2.0 * n * size_m + from - to, std::abs(2 * n)});
    images.push_back({2.0 * n * size_m - from - to, std::abs(2 * n - 1)});
  }
  std::erase_if(images, [&](const Image& image) { return std::abs(image.way_m) > most_m; });
  return images;
}

/// Calls visit(way in metres, reflections) for each image within `most_m`.
template <class Visit>
void for_each_image(const RoomEcho& room, Point<WorldFrame> from, Point<WorldFrame> to, double most_m,
                    const Visit& visit) {
  // z is measured from the floor, x and y from the middle.
  const double middle_m = 0.5 * room.size_m.z;
  const auto xs = images_along(room.size_m.x, from.v.x, to.v.x, most_m);
  const auto ys = images_along(room.size_m.y, from.v.y, to.v.y, most_m);
  const auto zs = images_along(room.size_m.z, from.v.z - middle_m, to.v.z - middle_m, most_m);
  for (const Image& x : xs)
    for (const Image& y : ys) {
      const double level_m2 = x.way_m * x.way_m + y.way_m * y.way_m;
      if (level_m2 > most_m * most_m) continue;
      for (const Image& z : zs) {
        const double way_m = std::sqrt(level_m2 + z.way_m * z.way_m);
        if (way_m <= most_m) visit(way_m, x.reflections + y.reflections + z.reflections);
      }
    }
}

constexpr int kParts = 64;
constexpr int kTaps = 2 * kEchoLead;

/// Sincs under a Hann window, delayed by kEchoLead samples and 0 to 63 of 64 parts of one.
const std::array<std::array<float, kTaps>, kParts>& delays() {
  static const auto table = [] {
    std::array<std::array<float, kTaps>, kParts> out{};
    for (int part = 0; part < kParts; ++part)
      for (int tap = 0; tap < kTaps; ++tap) {
        const double t = tap - kEchoLead - static_cast<double>(part) / kParts;
        const double angle = std::numbers::pi * t;
        const double sinc = std::abs(t) < 1e-9 ? 1.0 : std::sin(angle) / angle;
        const double window = std::abs(t) < kEchoLead ? 0.5 + 0.5 * std::cos(angle / kEchoLead) : 0.0;
        out[static_cast<std::size_t>(part)][static_cast<std::size_t>(tap)] =
            static_cast<float>(sinc * window);
      }
    return out;
  }();
  return table;
}

std::vector<double> powers_of(double reflection, std::size_t count) {
  std::vector<double> out{1.0};
  while (out.size() < count) out.push_back(out.back() * reflection);
  return out;
}

std::size_t most_reflections(const RoomEcho& room, double most_m) {
  const double shortest_m = std::min({room.size_m.x, room.size_m.y, room.size_m.z});
  return 3 * (static_cast<std::size_t>(most_m / shortest_m) + 3);
}

/// The energy of an impulse that arrives in each millisecond, by the number of its reflections.
struct EnergyTable {
  std::size_t orders = 0;
  std::vector<double> energy;

  double decay_s(double reflection) const;
};

/// The time in which the line through the Schroeder decay from -5 to -35 dB falls by 60 dB; infinity if it
/// ends before.
double EnergyTable::decay_s(double reflection) const {
  const std::vector<double> power = powers_of(reflection * reflection, orders);
  std::vector<double> left(energy.size() / orders);
  for (std::size_t at = left.size(); at-- > 0;) {
    for (std::size_t order = 0; order < orders; ++order)
      left[at] += energy[at * orders + order] * power[order];
    if (at + 1 < left.size()) left[at] += left[at + 1];
  }
  double sums[5] = {};
  bool is_whole = false;
  for (std::size_t at = 0; at < left.size() && !is_whole; ++at) {
    const double level_db = 10.0 * std::log10(left[at] / left.front());
    is_whole = level_db < -35.0;
    if (level_db > -5.0 || is_whole) continue;
    const double t = 1e-3 * static_cast<double>(at);
    const std::array<double, 5> terms{1.0, t, level_db, t * t, t * level_db};
    for (std::size_t n = 0; n < terms.size(); ++n) sums[n] += terms[n];
  }
  const double spread = sums[0] * sums[3] - sums[1] * sums[1];
  if (!is_whole || spread <= 0.0) return is_whole ? 0.0 : INFINITY;
  return -60.0 * spread / (sums[0] * sums[4] - sums[1] * sums[2]);
}

}  // namespace

std::vector<float> impulse_response(const RoomEcho& room, Point<WorldFrame> from, Point<WorldFrame> to,
                                    double rate_hz, double length_s) {
  const auto count = static_cast<std::size_t>(std::ceil(length_s * rate_hz)) + kTaps;
  const double most_m = length_s * room.speed_of_sound_m_per_s;
  const std::vector<double> gain = powers_of(room.reflection, most_reflections(room, most_m));
  const double samples_per_m = rate_hz / room.speed_of_sound_m_per_s;
  std::vector<float> response(count);
  const auto add = [&](double way_m, int reflections) {
    const double level = gain[static_cast<std::size_t>(reflections)] / way_m;
    if (level == 0.0) return;
    const double place = way_m * samples_per_m + 0.5 / kParts;
    const auto whole = static_cast<std::size_t>(place);
    const auto part = static_cast<std::size_t>((place - static_cast<double>(whole)) * kParts);
    const auto& taps = delays()[part];
    for (std::size_t tap = 0; tap < kTaps && whole + tap < count; ++tap)
      response[whole + tap] += static_cast<float>(level) * taps[tap];
  };
  if (room.reflection == 0.0)
    add(norm(from.v - to.v), 0);
  else
    for_each_image(room, from, to, most_m, add);
  return response;
}

double reflection_for(const RoomEcho& room, Point<WorldFrame> from, Point<WorldFrame> to,
                      double reverberation_s) {
  // The decay is followed to -35 dB; what comes later is below that.
  const double length_s = 0.8 * reverberation_s + 0.05;
  const double most_m = length_s * room.speed_of_sound_m_per_s;
  EnergyTable table;
  table.orders = most_reflections(room, most_m);
  table.energy.resize(table.orders * (static_cast<std::size_t>(length_s * 1e3) + 2));
  for_each_image(room, from, to, most_m, [&](double way_m, int reflections) {
    const auto at = static_cast<std::size_t>(1e3 * way_m / room.speed_of_sound_m_per_s);
    table.energy[at * table.orders + static_cast<std::size_t>(reflections)] += 1.0 / (way_m * way_m);
  });
  double low = 0.0, high = 1.0;
  for (int step = 0; step < 24; ++step) {
    const double middle = 0.5 * (low + high);
    (table.decay_s(middle) < reverberation_s ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace palpable::study
