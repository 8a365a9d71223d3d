// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/crc32.hpp"
#include "palpable/core/system/memory.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/recording/recording_decoder.hpp"
#include "palpable/device/recording/recording_format.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

namespace palpable::device {
namespace {

namespace format = recording_format;
/// Larger than any chunk that a writer makes: a larger stated size is damage.
constexpr std::uint32_t kMostChunk_bytes = format::kMostTicks * format::kTick_bytes;

struct Head {
  std::uint32_t kind = 0;
  std::uint32_t size = 0;
  std::uint32_t sum = 0;
};

Head head_of(ByteReader& in) {
  Head head;
  head.kind = in.u32();
  head.size = in.u32();
  head.sum = in.u32();
  return head;
}

/// The next complete chunk of a file in memory.
RecordingEnd next_chunk(ByteReader& in, RecordingChunk& chunk) {
  const Head head = head_of(in);
  if (!in.ok() || head.size > in.left()) return RecordingEnd::cut;
  chunk = {head.kind, in.bytes(head.size)};
  return crc32(chunk.payload) == head.sum ? RecordingEnd::not_yet : RecordingEnd::damaged;
}

Error not_a_recording(std::span<const std::byte> magic, const std::string& name) {
  if (has_magic(magic, "PALPREC"))
    return invalid_input("is a recording of a newer version than this program reads", name);
  return invalid_input("is not a recording", name);
}

Error damaged_header(const std::string& name) {
  return invalid_input("is a recording with a damaged header", name);
}

Error with_wrong_times(const RecordingDecoder& decoder, const std::string& name) {
  return invalid_input("is a recording with " + decoder.wrong_times(), name);
}

bool is_header(const RecordingChunk& chunk) {
  return chunk.kind == format::kHeader && chunk.payload.size() <= format::kMostText_bytes;
}

}  // namespace

Result<Recording> parse_recording(std::span<const std::byte> bytes, const std::string& name) {
  if (!has_magic(bytes, format::kMagic)) return not_a_recording(bytes, name);
  ByteReader in(bytes);
  in.skip(format::kMagic.size());
  RecordingChunk chunk;
  if (next_chunk(in, chunk) != RecordingEnd::not_yet || !is_header(chunk)) return damaged_header(name);
  Recording recording;
  recording.header_json = as_text(chunk.payload);
  RecordingDecoder decoder;
  while (!recording.complete && in.left() > 0)
    if (next_chunk(in, chunk) != RecordingEnd::not_yet || !decoder.take(chunk, recording)) break;
  if (!decoder.wrong_times().empty()) return with_wrong_times(decoder, name);
  return recording;
}

struct RecordingReader::Impl {
  ~Impl() {
    if (stream != nullptr) std::fclose(stream);
  }
  bool read(std::size_t count);
  RecordingEnd next_chunk(RecordingChunk& chunk);

  std::FILE* stream = nullptr;
  std::string name;
  std::string header_json;
  std::uintmax_t size = 0;
  std::uintmax_t done = 0;
  /// Up to the end of the last valid chunk.
  std::uintmax_t valid_bytes = 0;
  /// Of the hand.
  std::uint64_t ticks = 0;
  std::vector<std::byte> buffer;
  RecordingDecoder decoder;
  Recording piece;
  RecordingEnd end = RecordingEnd::not_yet;
};

/// False if the file ends before that.
bool RecordingReader::Impl::read(std::size_t count) {
  buffer.resize(count);
  const std::size_t got = std::fread(buffer.data(), 1, count, stream);
  done += got;
  return got == count;
}

RecordingEnd RecordingReader::Impl::next_chunk(RecordingChunk& chunk) {
  if (!read(format::kChunkHead_bytes)) return RecordingEnd::cut;
  ByteReader in(buffer);
  const Head head = head_of(in);
  if (head.size > kMostChunk_bytes) return RecordingEnd::damaged;
  if (head.size > size - std::min(size, done)) return RecordingEnd::cut;
  if (!read(head.size)) return RecordingEnd::cut;
  chunk = {head.kind, buffer};
  return crc32(chunk.payload) == head.sum ? RecordingEnd::not_yet : RecordingEnd::damaged;
}

RecordingReader::RecordingReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingReader::~RecordingReader() = default;

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::filesystem::path& file) {
  auto impl = std::make_unique<Impl>();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) return invalid_input("is a folder, not a file", file.string());
  // Opening a pipe would wait for its writer.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return invalid_input("is not a regular file: a recording cannot be read from a pipe or a device",
                         file.string());
  impl->stream = std::fopen(file.c_str(), "rbe");
  if (impl->stream == nullptr)
    return invalid_input(std::string("cannot be read: ") + std::strerror(errno), file.string());
  impl->size = std::filesystem::file_size(file, error);
  if (error) return invalid_input("cannot be read: " + error.message(), file.string());
  // Files of the system that state no size, such as /proc/kmsg, may be waited for without end.
  if (impl->size == 0 || !impl->read(format::kMagic.size()) || !has_magic(impl->buffer, format::kMagic))
    return not_a_recording(impl->buffer, file.string());
  RecordingChunk chunk;
  if (impl->next_chunk(chunk) != RecordingEnd::not_yet || !is_header(chunk))
    return damaged_header(file.string());
  impl->name = file.string();
  impl->header_json = as_text(chunk.payload);
  impl->valid_bytes = impl->done;
  return std::unique_ptr<RecordingReader>(new RecordingReader(std::move(impl)));
}

const std::string& RecordingReader::header_json() const { return impl_->header_json; }

const Recording* RecordingReader::next() {
  Impl& it = *impl_;
  if (it.end != RecordingEnd::not_yet) return nullptr;
  it.piece.ticks.clear();
  it.piece.further.clear();
  it.piece.scenes.clear();
  RecordingChunk chunk;
  it.end = it.next_chunk(chunk);
  if (it.end == RecordingEnd::not_yet && !it.decoder.take(chunk, it.piece))
    it.end = it.decoder.wrong_times().empty() ? RecordingEnd::damaged : RecordingEnd::wrong_times;
  if (it.end == RecordingEnd::not_yet) it.valid_bytes = it.done;
  if (it.end == RecordingEnd::not_yet && it.piece.complete)
    it.end = it.done < it.size ? RecordingEnd::more_after_end : RecordingEnd::complete;
  if (it.end != RecordingEnd::not_yet) return nullptr;
  it.ticks += it.piece.ticks.size();
  return &it.piece;
}

Result<Recording> read_recording(const std::filesystem::path& file) {
  auto reader = RecordingReader::open(file);
  if (!reader) return std::move(reader).error();
  std::error_code none;
  const auto needed = static_cast<double>(std::filesystem::file_size(file, none)) / format::kTick_bytes *
                      static_cast<double>(sizeof(TouchSample));
  const auto available = available_memory_bytes();
  constexpr double kGigabyte = 1e9;
  if (available && needed > static_cast<double>(*available))
    return invalid_input("needs " + std::to_string(std::lround(std::ceil(needed / kGigabyte))) +
                             " GB of memory as a whole, and there are " +
                             std::to_string(std::lround(static_cast<double>(*available) / kGigabyte)) +
                             "; as .csv it is exported in small parts",
                         file.string());
  Recording recording;
  recording.header_json = (*reader)->header_json();
  while (const Recording* piece = (*reader)->next()) {
    recording.scenes.insert(recording.scenes.end(), piece->scenes.begin(), piece->scenes.end());
    recording.ticks.insert(recording.ticks.end(), piece->ticks.begin(), piece->ticks.end());
    recording.further.insert(recording.further.end(), piece->further.begin(), piece->further.end());
  }
  if (auto valid = (*reader)->check_end(); !valid) return std::move(valid).error();
  recording.complete = (*reader)->end() == RecordingEnd::complete;
  recording.lost = (*reader)->lost();
  return recording;
}

RecordingEnd RecordingReader::end() const { return impl_->end; }

Result<void> RecordingReader::check_end() const {
  if (impl_->end == RecordingEnd::wrong_times) return with_wrong_times(impl_->decoder, impl_->name);
  const std::string where = "; its first " + std::to_string(impl_->valid_bytes) + " bytes are readable alone";
  if (impl_->end == RecordingEnd::damaged)
    return invalid_input("is a recording that is damaged after " + std::to_string(impl_->ticks) +
                             (impl_->ticks == 1 ? " tick" : " ticks") + where,
                         impl_->name);
  if (impl_->end == RecordingEnd::more_after_end)
    return invalid_input("is a recording with data after its end mark" + where, impl_->name);
  return {};
}

std::uint64_t RecordingReader::lost() const { return impl_->piece.lost; }
double RecordingReader::fraction() const {
  return impl_->size > 0 ? static_cast<double>(impl_->done) / static_cast<double>(impl_->size) : 1.0;
}

}  // namespace palpable::device
