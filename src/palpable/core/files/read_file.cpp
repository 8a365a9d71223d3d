// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/read_file.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

namespace palpable {
namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

Error unreadable(const std::filesystem::path& path, int reason) {
  return invalid_input("cannot be read: " + std::generic_category().message(reason), path.string());
}

/// Opening a pipe that no program writes to would wait without end. Once a writer has opened it, reading
/// waits for what it writes.
Result<File> open_pipe(const std::filesystem::path& path) {
  constexpr int kWriterPatience_ms = 3000;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return unreadable(path, errno);
  File file(fdopen(descriptor, "rb"));
  if (!file) return unreadable(path, errno);
  pollfd readable{descriptor, POLLIN, 0};
  // Reading no byte does not tell whether there is a writer, so the first byte is read and put back.
  const int ready = poll(&readable, 1, kWriterPatience_ms);
  // A signal: reading would wait until the program is ended by force.
  if (ready < 0) return unreadable(path, errno);
  if (ready == 0) {
    const int first = std::fgetc(file.get());
    const bool has_writer = first != EOF || (std::ferror(file.get()) != 0 && errno == EAGAIN);
    if (!has_writer) return invalid_input("is a pipe that no program writes to", path.string());
    if (first != EOF) std::ungetc(first, file.get());
    std::clearerr(file.get());
  }
  if (fcntl(descriptor, F_SETFL, O_RDONLY) != 0) return unreadable(path, errno);
  return file;
}

Result<File> open_for_reading(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status)) return invalid_input("is a folder, not a file", path.string());
  // Reading a device may never end, or change its state.
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    return invalid_input("is a device, not a file", path.string());
  if (std::filesystem::is_fifo(status)) return open_pipe(path);
  File file(std::fopen(path.c_str(), "rbe"));
  if (!file) return unreadable(path, errno);
  return file;
}

/// Reads until the end of the file or until `limit` bytes are read. A pipe has no size, so the buffer is used
/// step by step; what is only reserved takes no memory, and growing by copies would take twice as much.
Result<std::vector<std::byte>> read_up_to(std::FILE* file, std::size_t limit,
                                          const std::filesystem::path& path) {
  constexpr std::size_t kStep = std::size_t{1} << 20U;
  std::vector<std::byte> bytes;
  bytes.reserve(limit);
  while (bytes.size() < limit) {
    const std::size_t had = bytes.size();
    bytes.resize(std::min(limit, had + std::max(kStep, had)));
    const std::size_t got = std::fread(bytes.data() + had, 1, bytes.size() - had, file);
    const bool end = got < bytes.size() - had;
    bytes.resize(had + got);
    if (std::ferror(file) != 0) return unreadable(path, errno);
    if (end) break;
  }
  return bytes;
}

/// Reads all of a file of this size, or of a pipe, which has none. Errors: of reading; more than `max_bytes`.
Result<std::vector<std::byte>> read_within(std::FILE* file, std::optional<std::uintmax_t> size,
                                           std::uintmax_t max_bytes, const std::filesystem::path& path) {
  if (!size) max_bytes = std::min(max_bytes, kMaxPipeBytes);
  const auto too_large = [&] {
    const bool in_mebibytes = max_bytes >= std::uintmax_t{1} << 20U;
    return invalid_input("is larger than the " + std::to_string(max_bytes >> (in_mebibytes ? 20U : 10U)) +
                             (in_mebibytes ? " MiB" : " KiB") + " that are read",
                         path.string());
  };
  if (size && *size > max_bytes) return too_large();
  const auto limit = static_cast<std::size_t>(size.value_or(max_bytes));
  // Reading one byte more than allowed detects a growing file and an endless pipe.
  auto bytes = read_up_to(file, limit + 1, path);
  if (bytes && bytes->size() > max_bytes) return too_large();
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  auto file = open_for_reading(path);
  if (!file) return std::move(file).error();
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(path, no_size);
  return read_within(file->get(), no_size ? std::nullopt : std::optional(size), max_bytes, path);
}

Result<std::vector<std::byte>> read_regular_file(const std::filesystem::path& path,
                                                 std::uintmax_t max_bytes) {
  // A pipe would be waited for, and may have taken the file's place at any time: so it is opened first.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return unreadable(path, errno);
  struct stat found {};
  const bool is_regular = ::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
  const File file(fdopen(descriptor, "rb"));
  if (!file) return unreadable(path, errno);
  if (!is_regular) return invalid_input("is a pipe, a folder or a device, and not a file", path.string());
  return read_within(file.get(), static_cast<std::uintmax_t>(found.st_size), max_bytes, path);
}

Result<std::string> read_text_file(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  const auto bytes = read_file(path, max_bytes);
  if (!bytes) return bytes.error();
  return std::string(as_text(*bytes));
}

Result<std::vector<std::byte>> read_file_start(const std::filesystem::path& path, std::size_t count) {
  std::error_code ignored;
  if (std::filesystem::is_fifo(path, ignored))
    return invalid_input("is a pipe, which can be read only once: save it as a file first", path.string());
  auto file = open_for_reading(path);
  if (!file) return std::move(file).error();
  return read_up_to(file->get(), count, path);
}

}  // namespace palpable
