// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_writer.hpp"
#include "palpable/core/files/crc32.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/recording/recording_format.hpp"

#include <cstdlib>

namespace {

namespace format = palpable::device::recording_format;

/// A file with correct checksums, so that the fuzzer gets past them: each chunk has one byte for its kind,
/// one for its length in units of 8 bytes, and that many bytes of the rest.
palpable::ByteWriter whole_file(std::span<const std::byte> rest) {
  constexpr std::uint32_t kKinds[] = {format::kHeader, format::kProgram, format::kTicks, format::kEnd, 7};
  palpable::ByteWriter file;
  file.text(format::kMagic);
  while (rest.size() >= 2) {
    const auto kind = kKinds[std::to_integer<std::size_t>(rest[0]) % std::size(kKinds)];
    const std::size_t wanted = std::to_integer<std::size_t>(rest[1]) * 8;
    rest = rest.subspan(2);
    const auto payload = rest.first(std::min(wanted, rest.size()));
    rest = rest.subspan(payload.size());
    file.u32(kind);
    file.u32(static_cast<std::uint32_t>(payload.size()));
    file.u32(palpable::crc32(payload));
    file.text({reinterpret_cast<const char*>(payload.data()), payload.size()});
  }
  return file;
}

/// Any bytes give at most as many ticks as the bytes can hold, or an error.
void check(std::span<const std::byte> file) {
  const auto recording = palpable::device::parse_recording(file, "fuzzed");
  if (recording && recording->ticks.size() * format::kTick_bytes > file.size()) std::abort();
  if (!recording && recording.error().message.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  check(bytes);
  check(whole_file(bytes).bytes());
  return 0;
}
