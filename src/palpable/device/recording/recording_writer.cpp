// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/byte_writer.hpp"
#include "palpable/core/crc32.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/recording/recording_format.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace palpable::device {
namespace {

namespace format = recording_format;

void put(ByteWriter& out, Vec3 v) {
  out.f64(v.x);
  out.f64(v.y);
  out.f64(v.z);
}

void put(ByteWriter& out, const TouchSample& tick) {
  out.u64(tick.tick);
  out.f64(tick.t_s);
  out.f64(tick.dt_s);
  put(out, tick.device_position.v);
  put(out, tick.position.v);
  put(out, tick.velocity_m_per_s.v);
  put(out, tick.proxy.v);
  put(out, tick.raw_force_N.v);
  put(out, tick.written_force_N.v);
  out.f64(tick.energy_J);
  out.u32(tick.flags);
  out.u32(tick.buttons);
  out.u32(tick.scene_id);
  out.u16(tick.label);
  out.u8(static_cast<std::uint8_t>(tick.status));
  out.u8(tick.probe);
}

void put_turn(ByteWriter& out, const TouchSample& tick) {
  for (const double value : tick.device_rotation) out.f64(value);
  put(out, tick.angular_velocity_rad_per_s.v);
  put(out, tick.raw_torque_Nm.v);
  put(out, tick.written_torque_Nm.v);
}

bool is_turned(const TouchSample& tick) {
  return tick.device_rotation != kNotTurned || tick.angular_velocity_rad_per_s.v != Vec3{} ||
         tick.raw_torque_Nm.v != Vec3{} || tick.written_torque_Nm.v != Vec3{};
}

}  // namespace

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& file,
                                                                 const std::string& header_json) {
  std::unique_ptr<RecordingWriter> writer(new RecordingWriter);
  writer->file_ = file;
  const auto failed = [&file](const char* why) {
    return Error{ErrorCode::failed, std::string("cannot be written: ") + why, file.string()};
  };
  constexpr mode_t kReadableByAll = 0666;
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kReadableByAll);
  if (descriptor < 0) return failed(std::strerror(errno));
  writer->stream_ = ::fdopen(descriptor, "wb");
  if (writer->stream_ == nullptr) {
    ::close(descriptor);
    return failed(std::strerror(errno));
  }
  // Held until the stream is closed. Emptied only then, so that a recording under way stays.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return failed("another recording is being written into it");
  static_cast<void>(!::ftruncate(descriptor, 0));  // a device or a pipe holds nothing
  std::fwrite(format::kMagic.data(), 1, format::kMagic.size(), writer->stream_);
  ByteWriter header;
  header.text(header_json);
  if (auto done = writer->write_chunk(format::kHeader, header.bytes()); !done) return std::move(done).error();
  return writer;
}

RecordingWriter::~RecordingWriter() {
  if (stream_ != nullptr) std::fclose(stream_);
}

Result<void> RecordingWriter::write(const RecordedScene& scene) {
  ByteWriter payload;
  payload.u32(scene.id);
  payload.text(scene.json);
  return write_chunk(format::kProgram, payload.bytes());
}

Result<void> RecordingWriter::write(std::span<const TouchSample> ticks) {
  std::vector<TouchSample> hand, further;
  for (const TouchSample& tick : ticks) (tick.probe == 0 ? hand : further).push_back(tick);
  if (auto done = write_ticks(format::kTicks, hand); !done) return done;
  return write_ticks(format::kMoreTicks, further);
}

Result<void> RecordingWriter::write_ticks(std::uint32_t kind, std::span<const TouchSample> ticks) {
  while (!ticks.empty()) {
    const auto part = ticks.first(std::min(ticks.size(), format::kMostTicks));
    // What is said of the next ticks stands before them, so that a cut file has no tick without it.
    if (auto done = write_turns(part); !done) return done;
    if (kind == format::kTicks)
      if (auto done = write_fades(part); !done) return done;
    ByteWriter payload;
    for (const auto& tick : part) put(payload, tick);
    if (auto done = write_chunk(kind, payload.bytes()); !done) return done;
    ticks = ticks.subspan(part.size());
  }
  return {};
}

Result<void> RecordingWriter::write_turns(std::span<const TouchSample> ticks) {
  if (std::none_of(ticks.begin(), ticks.end(), is_turned)) return {};
  ByteWriter payload;
  for (const auto& tick : ticks) put_turn(payload, tick);
  return write_chunk(format::kTurns, payload.bytes());
}

Result<void> RecordingWriter::write_fades(std::span<const TouchSample> ticks) {
  ByteWriter payload;
  for (const auto& tick : ticks)
    if (std::exchange(coming_scene_id_, tick.coming_scene_id) != tick.coming_scene_id) {
      payload.u64(tick.tick);
      payload.u32(tick.coming_scene_id);
    }
  return payload.bytes().empty() ? Result<void>() : write_chunk(format::kFades, payload.bytes());
}

Result<void> RecordingWriter::finish(std::uint64_t lost) {
  ByteWriter payload;
  payload.u64(lost);
  if (auto done = write_chunk(format::kEnd, payload.bytes()); !done) return done;
  const bool flushed = fsync(fileno(stream_)) == 0;
  const bool closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
  if (flushed && closed) return {};
  return Error{ErrorCode::failed, std::string("cannot be written: ") + std::strerror(errno), file_.string()};
}

Result<void> RecordingWriter::write_chunk(std::uint32_t kind, std::span<const std::byte> payload) {
  ByteWriter head;
  head.u32(kind);
  head.u32(static_cast<std::uint32_t>(payload.size()));
  head.u32(crc32(payload));
  const auto bytes = head.bytes();
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), stream_) == bytes.size() &&
                     std::fwrite(payload.data(), 1, payload.size(), stream_) == payload.size() &&
                     std::fflush(stream_) == 0;
  if (whole) return {};
  return Error{ErrorCode::failed, std::string("cannot be written: ") + std::strerror(errno), file_.string()};
}

}  // namespace palpable::device
