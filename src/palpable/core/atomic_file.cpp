// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable {
namespace {

/// What is there now and not a regular file (a device, a pipe) cannot be replaced by renaming.
bool takes_a_stream(const std::filesystem::path& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// The permissions of the file that is replaced; of a new one, what the person's umask leaves of rw-rw-rw-.
mode_t permissions_for(const std::filesystem::path& path) {
  struct stat old {};
  if (::stat(path.c_str(), &old) == 0) return old.st_mode & 07777U;
  // umask can only be read by setting it, and that would race with other threads; Linux shows it here.
  constexpr mode_t kUsual = 0644;
  std::FILE* status = std::fopen("/proc/self/status", "re");
  if (status == nullptr) return kUsual;
  unsigned mask = 0;
  char line[256];
  bool found = false;
  while (!found && std::fgets(line, sizeof line, status) != nullptr)
    found = std::sscanf(line, "Umask: %o", &mask) == 1;
  std::fclose(status);
  return found ? 0666U & ~mask : kUsual;
}

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  AtomicFile file;
  std::error_code none;
  file.path_ = std::filesystem::is_symlink(path, none) ? std::filesystem::weakly_canonical(path, none) : path;
  if (file.path_.empty()) file.path_ = path;
  if (takes_a_stream(file.path_)) {
    file.descriptor_ = ::open(file.path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.failure("cannot be written");
    return file;
  }
  if (std::filesystem::is_directory(file.path_, none))
    return Error{ErrorCode::failed, "cannot be written: it is a folder", path.string()};
  std::string beside =
      (file.path_.parent_path() / ("." + file.path_.filename().string() + ".XXXXXX")).string();
  file.descriptor_ = ::mkostemp(beside.data(), O_CLOEXEC);
  if (file.descriptor_ < 0) return file.failure("cannot be written");
  file.beside_ = beside;
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      beside_(std::exchange(other.beside_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this != &other) {
    discard();
    path_ = std::move(other.path_);
    beside_ = std::exchange(other.beside_, {});
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!beside_.empty()) ::unlink(beside_.c_str());
  beside_.clear();
}

Error AtomicFile::failure(std::string_view what) const {
  const int reason = errno;
  return {ErrorCode::failed, std::string(what) + ": " + std::generic_category().message(reason),
          path_.string()};
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
  if (!write_all(descriptor_, bytes)) return failure("cannot be written");
  return {};
}

Result<void> AtomicFile::commit() {
  if (beside_.empty()) {
    discard();
    return {};
  }
  // A file system without permissions (a USB stick) still deserves the file.
  static_cast<void>(::fchmod(descriptor_, permissions_for(path_)));
  if (::fsync(descriptor_) != 0) return failure("cannot be written");
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure("cannot be written");
  if (::rename(beside_.c_str(), path_.c_str()) != 0) return failure("cannot be replaced");
  beside_.clear();
  sync_folder(path_.has_parent_path() ? path_.parent_path() : std::filesystem::path("."));
  return {};
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  auto file = AtomicFile::create(path);
  if (!file) return std::move(file).error();
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

}  // namespace palpable
