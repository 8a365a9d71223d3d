// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/byte_reader.hpp"
#include "palpable/core/crc32.hpp"
#include "palpable/core/read_file.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/recording/recording_format.hpp"

#include <optional>

namespace palpable::device {
namespace {

namespace format = recording_format;
constexpr std::uintmax_t kMostFile_bytes = std::uintmax_t{4} << 30U;

struct Chunk {
  std::uint32_t kind = 0;
  std::span<const std::byte> payload;
};

/// The next whole, undamaged chunk; nothing at a cut, damaged or finished file's end.
std::optional<Chunk> next_chunk(ByteReader& in) {
  Chunk chunk;
  chunk.kind = in.u32();
  const std::uint32_t size = in.u32();
  const std::uint32_t sum = in.u32();
  chunk.payload = in.bytes(size);
  if (!in.ok() || crc32(chunk.payload) != sum) return std::nullopt;
  return chunk;
}

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

/// False where the chunk is not what its kind promises.
bool take(const Chunk& chunk, Recording& recording) {
  ByteReader in(chunk.payload);
  switch (chunk.kind) {
    case format::kProgram:
      if (chunk.payload.size() < 4 || chunk.payload.size() > format::kMostText_bytes) return false;
      recording.scenes.push_back({in.u32(), std::string(as_text(in.bytes(in.left())))});
      return true;
    case format::kTicks:
    case format::kMoreTicks: {
      if (chunk.payload.size() % format::kTick_bytes != 0) return false;
      auto& ticks = chunk.kind == format::kTicks ? recording.ticks : recording.further;
      while (in.left() > 0) ticks.push_back(tick(in));
      return true;
    }
    case format::kEnd:
      if (chunk.payload.size() != 8) return false;
      recording.lost = in.u64();
      recording.complete = true;
      return true;
    default:
      // A later minor version's: what we do not know we need not read.
      return true;
  }
}

}  // namespace

Result<Recording> parse_recording(std::span<const std::byte> bytes, const std::string& name) {
  if (has_magic(bytes, "PALPREC") && !has_magic(bytes, format::kMagic))
    return invalid_input("is a recording of a newer version than this program reads", name);
  if (!has_magic(bytes, format::kMagic)) return invalid_input("is not a recording", name);
  ByteReader in(bytes);
  in.skip(format::kMagic.size());
  const auto header = next_chunk(in);
  if (!header || header->kind != format::kHeader || header->payload.size() > format::kMostText_bytes)
    return invalid_input("is a recording with a damaged header", name);
  Recording recording;
  recording.header_json = as_text(header->payload);
  while (!recording.complete && in.left() > 0) {
    const auto chunk = next_chunk(in);
    if (!chunk || !take(*chunk, recording)) break;
  }
  return recording;
}

Result<Recording> read_recording(const std::filesystem::path& file) {
  auto bytes = read_file(file, kMostFile_bytes);
  if (!bytes) return std::move(bytes).error();
  return parse_recording(*bytes, file.string());
}

}  // namespace palpable::device
