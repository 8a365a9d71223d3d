// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/read_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/file_bytes.hpp"

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
  if (reason == EAGAIN) return invalid_input("is a stream of the system, not a file", path.string());
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
  // Some files of the system, such as /proc/kmsg, are waited for like a pipe.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return unreadable(path, errno);
  File file(fdopen(descriptor, "rb"));
  if (!file) return unreadable(path, errno);
  return file;
}

/// Reads until the end of the file or until `limit` bytes are there, after those that were read before. A
/// pipe has no size, so the buffer is used step by step; what is only reserved takes no memory, and growing
/// by copies would take twice as much.
Result<std::vector<std::byte>> read_up_to(std::FILE* file, std::size_t limit,
                                          const std::filesystem::path& path,
                                          std::span<const std::byte> before = {}) {
  constexpr std::size_t kStep = std::size_t{1} << 20U;
  std::vector<std::byte> bytes;
  bytes.reserve(limit);
  bytes.assign(before.begin(), before.end());
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

/// The same into a memory file.
Result<SharedBytes> share_up_to(std::FILE* file, std::size_t limit, const std::filesystem::path& path,
                                std::span<const std::byte> before) {
  const auto unshared = [&path](Error error) {
    error.message = "cannot be kept for its decoder: " + error.message;
    error.place = path.string();
    return error;
  };
  auto writer = SharedBytes::Writer::begin();
  if (!writer) return unshared(std::move(writer).error());
  // In the processor's cache.
  std::vector<std::byte> buffer(std::size_t{256} << 10U);
  std::span<const std::byte> part = before;
  for (std::size_t taken = before.size();; taken += part.size()) {
    if (auto put = writer->put(part); !put) return unshared(std::move(put).error());
    const std::size_t wanted = std::min(buffer.size(), limit - taken);
    part = std::span(buffer).first(wanted > 0 ? std::fread(buffer.data(), 1, wanted, file) : 0);
    if (std::ferror(file) != 0) return unreadable(path, errno);
    if (part.empty()) break;
  }
  auto shared = std::move(*writer).sealed();
  if (!shared) return unshared(std::move(shared).error());
  return shared;
}

/// How much of a file may be read.
class Bound {
 public:
  /// Errors: a file that is larger than `max_bytes`. A pipe has no size.
  static Result<Bound> of(std::optional<std::uintmax_t> size, std::uintmax_t max_bytes,
                          const std::filesystem::path& path) {
    const Bound bound(size ? max_bytes : std::min(max_bytes, kMaxPipeBytes), size);
    if (size && *size > bound.max_bytes_) return bound.too_large(path);
    return bound;
  }
  /// Reading one byte more than allowed detects a growing file and an endless pipe.
  std::size_t limit() const { return static_cast<std::size_t>(size_.value_or(max_bytes_)) + 1; }
  bool is_exceeded_by(std::size_t bytes) const { return bytes > max_bytes_; }
  Error too_large(const std::filesystem::path& path) const {
    const bool in_mebibytes = max_bytes_ >= std::uintmax_t{1} << 20U;
    return invalid_input("is larger than the " + std::to_string(max_bytes_ >> (in_mebibytes ? 20U : 10U)) +
                             (in_mebibytes ? " MiB" : " KiB") + " that are read",
                         path.string());
  }

 private:
  Bound(std::uintmax_t max_bytes, std::optional<std::uintmax_t> size) : max_bytes_(max_bytes), size_(size) {}
  std::uintmax_t max_bytes_;
  std::optional<std::uintmax_t> size_;
};

std::optional<std::uintmax_t> size_of(const std::filesystem::path& path) {
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(path, no_size);
  return no_size ? std::nullopt : std::optional(size);
}

/// Reads all of a file of this size, or of a pipe, which has none. Errors: of reading; more than `max_bytes`.
Result<std::vector<std::byte>> read_within(std::FILE* file, std::optional<std::uintmax_t> size,
                                           std::uintmax_t max_bytes, const std::filesystem::path& path) {
  const auto bound = Bound::of(size, max_bytes, path);
  if (!bound) return bound.error();
  auto bytes = read_up_to(file, bound->limit(), path);
  if (bytes && bound->is_exceeded_by(bytes->size())) return bound->too_large(path);
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  auto file = open_for_reading(path);
  if (!file) return std::move(file).error();
  return read_within(file->get(), size_of(path), max_bytes, path);
}

Result<FileBytes> read_file_bytes(const std::filesystem::path& path,
                                  bool (*for_a_child)(std::span<const std::byte> start),
                                  std::uintmax_t max_bytes) {
  const auto file = open_for_reading(path);
  if (!file) return file.error();
  const auto bound = Bound::of(size_of(path), max_bytes, path);
  if (!bound) return bound.error();
  constexpr std::size_t kStart = 4096;
  const auto start = read_up_to(file->get(), std::min(kStart, bound->limit()), path);
  if (!start) return start.error();
  std::optional<FileBytes> whole;
  if (for_a_child(*start)) {
    auto shared = share_up_to(file->get(), bound->limit(), path, *start);
    if (!shared) return std::move(shared).error();
    whole.emplace(*std::move(shared));
  } else {
    auto bytes = read_up_to(file->get(), bound->limit(), path, *start);
    if (!bytes) return std::move(bytes).error();
    whole.emplace(*std::move(bytes));
  }
  if (bound->is_exceeded_by(whole->view().bytes().size())) return bound->too_large(path);
  return *std::move(whole);
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
