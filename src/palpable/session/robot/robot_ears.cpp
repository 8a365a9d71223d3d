// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_ears.hpp"

#include "palpable/core/sound/sound.hpp"
#include "palpable/describe/sound_words.hpp"

#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

constexpr double kRadian_deg = 180.0 / std::numbers::pi;

/// -pi to pi.
double turned(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

/// Bytes of a sample; 0: such samples are not read.
std::size_t bytes_of(std::string_view samples) {
  if (samples == "S16LE") return sizeof(std::int16_t);
  return samples == "S32LE" || samples == "F32LE" ? sizeof(std::int32_t) : 0;
}

template <class Number>
float sample_at(std::span<const std::byte> part, std::size_t at, double scale) {
  Number number{};
  std::memcpy(&number, part.data() + at, sizeof number);
  return static_cast<float>(static_cast<double>(number) * scale);
}

float sample_at(std::span<const std::byte> part, std::size_t at, std::string_view samples) {
  if (samples == "S16LE") return sample_at<std::int16_t>(part, at, 0x1p-15);
  if (samples == "S32LE") return sample_at<std::int32_t>(part, at, 0x1p-31);
  return sample_at<float>(part, at, 1.0);
}

}  // namespace

RobotEars::RobotEars(Microphones microphones, SoundFormat format, hearing::Listener listener)
    : microphones_(std::move(microphones)),
      format_(std::move(format)),
      listener_(std::move(listener)),
      tracks_(listener_.geometry().shape) {}

Result<RobotEars> RobotEars::create(Microphones microphones, SoundFormat format) {
  format.channels = static_cast<int>(microphones.positions_m.size());
  auto listener = hearing::Listener::create(microphones, format.rate_hz);
  if (!listener) return std::move(listener).error();
  return RobotEars(std::move(microphones), std::move(format), *std::move(listener));
}

Result<void> RobotEars::take_format(const SoundFormat& format) {
  if (format.channels != format_.channels)
    return invalid_input(fmt::format("sends sound of {} channels, but there are {} microphones",
                                     format.channels, format_.channels));
  if (bytes_of(format.samples) == 0)
    return invalid_input("sends sound in another format than S16LE, S32LE or F32LE");
  if (format.rate_hz != format_.rate_hz) {
    auto listener = hearing::Listener::create(microphones_, format.rate_hz);
    if (!listener) return std::move(listener).error();
    listener_ = *std::move(listener);
    tracks_ = hearing::SoundTracks(listener_.geometry().shape);
  }
  format_ = format;
  return {};
}

void RobotEars::take(std::span<const std::byte> part, double now_s, double heading_rad) {
  const std::size_t bytes = bytes_of(format_.samples), channels = microphones_.positions_m.size();
  const std::size_t length = part.size() / (bytes * channels);
  Sound sound{format_.rate_hz, std::vector(channels, std::vector<float>(length))};
  for (std::size_t k = 0; k < length; ++k)
    for (std::size_t c = 0; c < channels; ++c)
      sound.channels[c][k] = sample_at(part, bytes * (channels * k + c), format_.samples);
  for (const auto& window : listener_.take(sound)) hear(window, now_s, heading_rad);
}

void RobotEars::hear(const hearing::HeardWindow& window, double now_s, double heading_rad) {
  const bool is_new = tracks_.take(window).has_value();
  // Their ends are of no use here.
  static_cast<void>(tracks_.take_ended(false));
  if (!window.direction) return;
  const auto bearing = hearing::bearing_of(*window.direction, listener_.geometry().shape);
  direction_rad_ = turned(heading_rad - bearing.azimuth_deg / kRadian_deg);
  heard_s_ = now_s;
  if (!is_new) return;
  ++sounds_;
  // Syllables of one voice are one sound to a person.
  constexpr double kSame_rad = 20.0 / kRadian_deg, kAgain_s = 10.0;
  if (said_rad_ && std::abs(turned(*direction_rad_ - *said_rad_)) < kSame_rad && now_s - said_s_ < kAgain_s)
    return;
  said_rad_ = direction_rad_;
  said_s_ = now_s;
  unsaid_ = fmt::format("A sound {}.", describe::sound_words(bearing.azimuth_deg, bearing.elevation_deg));
}

std::optional<std::string> RobotEars::words() { return std::exchange(unsaid_, std::nullopt); }

std::optional<double> RobotEars::azimuth_rad(double now_s, double heading_rad) const {
  if (!direction_rad_ || now_s - heard_s_ > kRemembered_s) return std::nullopt;
  return turned(heading_rad - *direction_rad_);
}

void mark_direction(Raster<std::uint8_t>& labels, std::uint8_t label, const Pinhole& camera, double down_rad,
                    double azimuth_rad) {
  constexpr double kHalf_rad = 3.0 / kRadian_deg;
  const double c = std::cos(down_rad), s = std::sin(down_rad);
  for (int y = 0; y < labels.height(); ++y) {
    const double v = (y - camera.cy) / camera.fy;
    // Ahead in the robot's level: the ray (u, v, 1) turned up by down_rad.
    const double ahead = c - s * v;
    for (int x = 0; x < labels.width(); ++x) {
      const double u = (x - camera.cx) / camera.fx;
      if (std::abs(turned(std::atan2(u, ahead) - azimuth_rad)) < kHalf_rad) labels(x, y) = label;
    }
  }
}

models::Material sound_material() {
  models::Material material;
  material.name = "a sound comes from here";
  // Coarser than the grain of what is remembered.
  material.texture.kind = models::TouchTexture::Kind::grain;
  material.texture.pitch_m = 0.003;
  material.texture.height_m = 80e-6;
  return material;
}

}  // namespace palpable::session
