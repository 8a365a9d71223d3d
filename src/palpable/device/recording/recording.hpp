// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/touch_sample.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace palpable::device {

/// Description of what was touched from a tick on, as JSON: scene hash, law, parameters, scene_from_device.
struct RecordedScene {
  std::uint32_t id = 0;
  std::string json;
};

struct Recording {
  /// Data of the whole session, JSON (docs/recording.md).
  std::string header_json;
  std::vector<RecordedScene> scenes;
  /// Ticks of the hand, probe 0.
  std::vector<TouchSample> ticks;
  /// Ticks of further probes, each after the hand's tick of the same time.
  std::vector<TouchSample> further;
  /// Number of ticks that were lost because the disk was too slow, as far as the file states it.
  std::uint64_t lost = 0;
  /// False if the program was killed, or the file was truncated, before the end mark; everything before is
  /// valid.
  bool complete = false;
};

/// Reads a whole recording. If a file is truncated, the part before that place is returned with complete =
/// false. Errors (invalid_input): not a recording, a newer version, a damaged one, times that are not finite
/// or do not increase, more ticks than fit into memory.
Result<Recording> read_recording(const std::filesystem::path& file);
/// The same from memory, except that of a damaged recording too the part before the damage is returned;
/// `name` is the place of errors.
Result<Recording> parse_recording(std::span<const std::byte> bytes, const std::string& name);

/// How a recording's file ends.
enum class RecordingEnd : std::uint8_t {
  /// There is more to read.
  not_yet,
  complete,
  /// Without an end mark: the writing program was killed, or the file was truncated.
  cut,
  /// At a chunk with a wrong checksum or structure; what follows it is unknown.
  damaged,
  /// The times of its ticks are not finite or do not increase (RecordingDecoder).
  wrong_times,
  /// Further bytes follow the end mark.
  more_after_end
};

/// Reads a recording of any size chunk by chunk, using about ten megabytes at most. One thread.
class RecordingReader {
 public:
  /// Errors (invalid_input): as read_recording(), but without a limit of the size.
  static Result<std::unique_ptr<RecordingReader>> open(const std::filesystem::path& file);
  ~RecordingReader();
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  const std::string& header_json() const;
  /// The content of the next chunk, valid until the next call; null at the end.
  const Recording* next();
  /// How the file ends; valid after next() returned null.
  RecordingEnd end() const;
  /// Error (invalid_input) for a damaged file, with the size of its undamaged part, and for one with wrong
  /// times; a truncated one is valid.
  /// After next() returned null.
  Result<void> check_end() const;
  /// Recording::lost, after a complete end.
  std::uint64_t lost() const;
  /// The fraction of the file that was read, 0 ... 1.
  double fraction() const;

 private:
  struct Impl;
  explicit RecordingReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Writes a recording incrementally: if the program is killed, what was written stays readable. Not for the
/// tick path; one thread.
class RecordingWriter {
 public:
  /// Replaces an old file of that name once the header is written, and holds an advisory lock on the file
  /// while it writes. Errors (failed): cannot be created; another writer holds the lock.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& file,
                                                         const std::string& header_json);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Errors (failed): for example a full disk. After an error the file ends with its last complete chunk.
  Result<void> write(const RecordedScene& scene);
  /// Ticks of any probes; the file stores the hand's ticks and those of further probes separately.
  Result<void> write(std::span<const TouchSample> ticks);
  /// Writes the end mark and flushes to the disk. At most once, as the last call.
  Result<void> finish(std::uint64_t lost);

 private:
  RecordingWriter() = default;
  Result<void> write_ticks(std::uint32_t kind, std::span<const TouchSample> ticks);
  Result<void> write_turns(std::span<const TouchSample> ticks);
  Result<void> write_fades(std::span<const TouchSample> ticks);
  Result<void> write_chunk(std::uint32_t kind, std::span<const std::byte> payload);
  Result<void> write_bytes(std::span<const std::byte> bytes);

  std::filesystem::path file_;
  std::FILE* stream_ = nullptr;
  /// Of the hand's last tick.
  std::uint32_t coming_scene_id_ = 0;
};

}  // namespace palpable::device
