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

/// What was touched, and how, from a tick on. Text in JSON: scene hash, law, parameters, scene_from_device.
struct RecordedScene {
  std::uint32_t id = 0;
  std::string json;
};

struct Recording {
  /// What holds for the whole session, JSON (docs/recording.md).
  std::string header_json;
  std::vector<RecordedScene> scenes;
  /// The hand's, probe 0.
  std::vector<TouchSample> ticks;
  /// Those of further probes, each after the hand's of the same time.
  std::vector<TouchSample> further;
  /// Ticks that the recorder lost because the disk was too slow, as far as the file could say.
  std::uint64_t lost = 0;
  /// False if the program was killed, or the file cut, before its end was written; everything before is
  /// whole.
  bool complete = false;
};

/// Reads a whole recording. A file that ends early or is damaged further on gives what stands before, with
/// complete = false. Errors (invalid_input): not a recording, a newer version, a damaged header, more ticks
/// than there is memory for.
Result<Recording> read_recording(const std::filesystem::path& file);
/// The same from memory; `name` is for the errors' place.
Result<Recording> parse_recording(std::span<const std::byte> bytes, const std::string& name);

/// How a recording's file ends.
enum class RecordingEnd : std::uint8_t {
  /// There is more to read.
  not_yet,
  complete,
  /// In the middle: the program that wrote it was killed, or the file was cut.
  cut,
  /// At a chunk whose checksum or shape is wrong; what follows it is unknown.
  damaged,
  /// Bytes follow its end mark.
  more_after_end
};

/// Reads a recording of any size chunk by chunk, in at most some ten megabytes. One thread.
class RecordingReader {
 public:
  /// Errors (invalid_input): as read_recording(), but any size will do.
  static Result<std::unique_ptr<RecordingReader>> open(const std::filesystem::path& file);
  ~RecordingReader();
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  const std::string& header_json() const;
  /// What the next chunk adds, valid until the next call; null at the end.
  const Recording* next();
  /// After next() gave null.
  RecordingEnd end() const;
  /// Recording::lost, after a complete end.
  std::uint64_t lost() const;
  /// How much of the file was read, 0 ... 1.
  double fraction() const;

 private:
  struct Impl;
  explicit RecordingReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Writes a recording bit by bit: what was written stays readable if the program is killed. Not for the tick
/// path; one thread.
class RecordingWriter {
 public:
  /// Replaces an old file of that name once the header is written, and holds an advisory lock on the file
  /// while it writes. Errors (failed): cannot be created; another writer holds the lock.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& file,
                                                         const std::string& header_json);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Errors (failed): the disk is full, or the like. After an error the file ends with its last whole chunk.
  Result<void> write(const RecordedScene& scene);
  /// Of any probes; in the file the hand's ticks and those of further probes stand apart.
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
  /// Of the last of the hand's ticks.
  std::uint32_t coming_scene_id_ = 0;
};

}  // namespace palpable::device
