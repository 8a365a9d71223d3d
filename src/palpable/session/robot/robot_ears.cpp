// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_ears.hpp"

#include "palpable/core/check.hpp"
#include "palpable/describe/sound_words.hpp"
#include "palpable/hearing/channel_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
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
  PALPABLE_CHECK(bytes_of(format.samples) > 0);
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
    taken_s_ = 0.0;
  }
  // What is left of an instant, and what is not checked yet, is of the format before.
  if (format.rate_hz != format_.rate_hz || format.samples != format_.samples) {
    rest_.clear();
    first_ = {};
  }
  format_ = format;
  return {};
}

void RobotEars::turn(double now_s, double heading_rad) {
  constexpr double kKept_s = 3.0;
  headings_.push_back({now_s, heading_rad});
  while (headings_.front().time_s < now_s - kKept_s) headings_.pop_front();
}

double RobotEars::heading_at(double time_s) const {
  if (headings_.empty()) return 0.0;
  const auto after = std::find_if(headings_.begin(), headings_.end(),
                                  [&](const Heading& heading) { return heading.time_s >= time_s; });
  if (after == headings_.end()) return headings_.back().heading_rad;
  if (after == headings_.begin()) return after->heading_rad;
  const Heading& before = *std::prev(after);
  const double share = (time_s - before.time_s) / std::max(1e-9, after->time_s - before.time_s);
  return before.heading_rad + share * turned(after->heading_rad - before.heading_rad);
}

void RobotEars::take(std::span<const std::byte> part, double now_s) {
  const std::size_t bytes = bytes_of(format_.samples), channels = microphones_.positions_m.size();
  PALPABLE_CHECK(bytes > 0 && channels > 0);
  rest_.insert(rest_.end(), part.begin(), part.end());
  const std::size_t length = rest_.size() / (bytes * channels);
  Sound sound{format_.rate_hz, std::vector(channels, std::vector<float>(length))};
  bool are_numbers = true;
  for (std::size_t k = 0; k < length; ++k)
    for (std::size_t c = 0; c < channels; ++c) {
      const float value = sample_at(rest_, bytes * (channels * k + c), format_.samples);
      are_numbers = are_numbers && std::isfinite(value);
      sound.channels[c][k] = value;
    }
  rest_.erase(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(bytes * channels * length));
  if (!are_numbers && !std::exchange(said_numbers_, true))
    unsaid_ = "The robot sends sound with values that are no numbers; such parts are left out.";
  if (!are_numbers) return;
  if (!are_checked_ && !is_checked(sound)) return;
  taken_s_ += sound.duration_s();
  for (const auto& window : listener_.take(sound)) hear(window, now_s);
}

/// Whether the channels can be of microphones of their own, by the first quarter of a second that is not
/// silent: until that is known, what came is kept, and `sound` is all of it then.
bool RobotEars::is_checked(Sound& sound) {
  if (are_faulty_) return false;
  const auto is_silent = [](const std::vector<float>& channel) {
    return std::all_of(channel.begin(), channel.end(), [](float value) { return value == 0.0F; });
  };
  if (first_.length() == 0 && std::all_of(sound.channels.begin(), sound.channels.end(), is_silent))
    return true;
  first_.rate_hz = sound.rate_hz;
  first_.channels.resize(sound.channels.size());
  for (std::size_t c = 0; c < sound.channels.size(); ++c)
    first_.channels[c].insert(first_.channels[c].end(), sound.channels[c].begin(), sound.channels[c].end());
  constexpr double kEnough_s = 0.25;
  if (first_.duration_s() < kEnough_s) return false;
  sound = std::exchange(first_, {});
  const auto checked = hearing::check_channels(sound);
  are_checked_ = checked.has_value();
  are_faulty_ = !are_checked_;
  if (are_faulty_)
    unsaid_ = fmt::format("The robot's sound {}: it is not listened to.", checked.error().message);
  return are_checked_;
}

void RobotEars::hear(const hearing::HeardWindow& window, double now_s) {
  const bool is_new = tracks_.take(window).has_value();
  // Their ends are of no use here.
  static_cast<void>(tracks_.take_ended(false));
  if (!window.direction) return;
  const auto bearing = hearing::bearing_of(*window.direction, listener_.geometry().shape);
  const double middle_s = now_s - (taken_s_ - 0.5 * (window.begin_s + window.end_s));
  direction_rad_ = turned(heading_at(middle_s) - bearing.azimuth_deg / kRadian_deg);
  heard_s_ = now_s;
  if (!is_new) return;
  ++sounds_;
  // Syllables of one voice are one sound to a person.
  constexpr double kSame_rad = 20.0 / kRadian_deg, kAgain_s = 10.0;
  const double from_robot_rad = turned(heading_at(now_s) - *direction_rad_);
  if (said_rad_ && std::abs(turned(from_robot_rad - *said_rad_)) < kSame_rad && now_s - said_s_ < kAgain_s)
    return;
  said_rad_ = from_robot_rad;
  said_s_ = now_s;
  unsaid_ =
      fmt::format("A sound {}.", describe::sound_words(from_robot_rad * kRadian_deg, bearing.elevation_deg));
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
