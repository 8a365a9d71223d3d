// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/byte_writer.hpp"
#include "palpable/core/files/crc32.hpp"
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
namespace fs = std::filesystem;

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
  return tick.device_rotation != kIdentityRotation || tick.angular_velocity_rad_per_s.v != Vec3{} ||
         tick.raw_torque_Nm.v != Vec3{} || tick.written_torque_Nm.v != Vec3{};
}

void put_chunk(ByteWriter& out, std::uint32_t kind, std::span<const std::byte> payload) {
  out.u32(kind);
  out.u32(static_cast<std::uint32_t>(payload.size()));
  out.u32(crc32(payload));
  out.text(as_text(payload));
}

Error cannot_be_written(const std::filesystem::path& file) {
  return {ErrorCode::failed, std::string("cannot be written: ") + std::strerror(errno), file.string()};
}

Error locked(const std::filesystem::path& file) {
  return {ErrorCode::failed, "cannot be written: another recording is being written into it", file.string()};
}

/// A running recording holds a lock on its file. Errors: failed.
Result<void> check_not_locked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return {};
  const bool is_locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return is_locked ? Result<void>(locked(file)) : Result<void>();
}

}  // namespace

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& file,
                                                                 const std::string& header_json) {
  if (auto free = check_not_locked(file); !free) return std::move(free).error();
  ByteWriter start;
  start.text(format::kMagic);
  put_chunk(start, format::kHeader, std::as_bytes(std::span(header_json)));
  // The old recording is kept until this one is readable. A device or a pipe contains none.
  std::error_code none;
  const bool is_stream = fs::exists(file, none) && !fs::is_regular_file(file, none);
  if (!is_stream)
    if (auto written = write_file_atomically(file, start.bytes()); !written)
      return std::move(written).error();
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) return cannot_be_written(file);
  std::unique_ptr<RecordingWriter> writer(new RecordingWriter);
  writer->file_ = file;
  writer->stream_ = ::fdopen(descriptor, "ab");
  if (writer->stream_ == nullptr) {
    const Error error = cannot_be_written(file);
    ::close(descriptor);
    return error;
  }
  // Held until the stream is closed.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return locked(file);
  if (is_stream)
    if (auto written = writer->write_bytes(start.bytes()); !written) return std::move(written).error();
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
    // Chunks that describe the next ticks come before them, so that a truncated file has no tick without its
    // description.
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
  return cannot_be_written(file_);
}

Result<void> RecordingWriter::write_chunk(std::uint32_t kind, std::span<const std::byte> payload) {
  ByteWriter chunk;
  put_chunk(chunk, kind, payload);
  return write_bytes(chunk.bytes());
}

Result<void> RecordingWriter::write_bytes(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) == bytes.size() && std::fflush(stream_) == 0)
    return {};
  return cannot_be_written(file_);
}

}  // namespace palpable::device
