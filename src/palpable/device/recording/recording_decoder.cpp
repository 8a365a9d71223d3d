// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/recording/recording_decoder.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/device/recording/recording_format.hpp"

#include <cmath>
#include <string>

namespace palpable::device {
namespace {

namespace format = recording_format;

Vec3 vec3(ByteReader& in) {
  const double x = in.f64();
  const double y = in.f64();
  return {x, y, in.f64()};
}

TouchSample tick(ByteReader& in) {
  TouchSample tick;
  tick.tick = in.u64();
  tick.t_s = in.f64();
  tick.dt_s = in.f64();
  tick.device_position = {vec3(in)};
  tick.position = {vec3(in)};
  tick.velocity_m_per_s = {vec3(in)};
  tick.proxy = {vec3(in)};
  tick.raw_force_N = {vec3(in)};
  tick.written_force_N = {vec3(in)};
  tick.energy_J = in.f64();
  tick.flags = in.u32();
  tick.buttons = in.u32();
  tick.scene_id = in.u32();
  tick.label = in.u16();
  const std::uint8_t status = in.u8();
  tick.status =
      status <= static_cast<std::uint8_t>(Status::fault) ? static_cast<Status>(status) : Status::fault;
  tick.probe = in.u8();
  return tick;
}

void add_turn(ByteReader& in, TouchSample& tick) {
  for (double& value : tick.device_rotation) value = in.f64();
  tick.angular_velocity_rad_per_s = {vec3(in)};
  tick.raw_torque_Nm = {vec3(in)};
  tick.written_torque_Nm = {vec3(in)};
}

}  // namespace

bool RecordingDecoder::take(const RecordingChunk& chunk, Recording& recording) {
  ByteReader in(chunk.payload);
  switch (chunk.kind) {
    case format::kHeader:
      // There is one, at the beginning.
      return false;
    case format::kProgram:
      if (chunk.payload.size() < 4 || chunk.payload.size() > format::kMostText_bytes) return false;
      recording.scenes.push_back({in.u32(), std::string(as_text(in.bytes(in.left())))});
      return true;
    case format::kTicks:
      return take_ticks(chunk, recording.ticks);
    case format::kMoreTicks:
      return take_ticks(chunk, recording.further);
    case format::kTurns:
      if (chunk.payload.size() % format::kTurn_bytes != 0) return false;
      turns_.assign(chunk.payload.begin(), chunk.payload.end());
      return true;
    case format::kFades:
      if (chunk.payload.size() % format::kFade_bytes != 0) return false;
      fades_.clear();
      next_fade_ = 0;
      while (in.left() > 0) {
        const std::uint64_t from = in.u64();
        fades_.push_back({from, in.u32()});
      }
      return true;
    case format::kEnd:
      if (chunk.payload.size() != 8) return false;
      recording.lost = in.u64();
      recording.complete = true;
      return true;
    default:
      // A chunk of a later minor version: unknown kinds are skipped.
      return true;
  }
}

bool RecordingDecoder::take_ticks(const RecordingChunk& chunk, std::vector<TouchSample>& ticks) {
  if (chunk.payload.size() % format::kTick_bytes != 0) return false;
  ByteReader in(chunk.payload);
  ByteReader turns(turns_);
  const bool turned = turns_.size() / format::kTurn_bytes == chunk.payload.size() / format::kTick_bytes;
  while (in.left() > 0) {
    ticks.push_back(tick(in));
    if (turned) add_turn(turns, ticks.back());
    if (!is_in_time(ticks.back(), chunk.kind == format::kTicks)) return false;
    if (chunk.kind == format::kTicks) add_fade(ticks.back());
  }
  turns_.clear();
  return true;
}

bool RecordingDecoder::is_in_time(const TouchSample& tick, bool of_hand) {
  const char* wrong = nullptr;
  if (!std::isfinite(tick.t_s) || !std::isfinite(tick.dt_s)) {
    wrong = "times that are not finite";
  } else if (tick.dt_s < 0.0) {
    wrong = "a negative period";
  } else if (of_hand && tick.t_s <= before_s_) {
    wrong = "times that do not increase";
  }
  if (wrong != nullptr) {
    wrong_times_ = std::string(wrong) + " at tick " + std::to_string(tick.tick);
    return false;
  }
  if (of_hand) before_s_ = tick.t_s;
  return true;
}

void RecordingDecoder::add_fade(TouchSample& tick) {
  for (; next_fade_ < fades_.size() && fades_[next_fade_].tick <= tick.tick; ++next_fade_)
    coming_scene_id_ = fades_[next_fade_].coming_scene_id;
  tick.coming_scene_id = coming_scene_id_;
}

}  // namespace palpable::device
