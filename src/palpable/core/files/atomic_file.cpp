// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/atomic_file.hpp"

#include "palpable/core/work.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable {
namespace {

/// An existing file that is not regular (a device, a pipe) cannot be replaced by renaming.
bool takes_a_stream(const std::filesystem::path& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// The permissions of the replaced file; for a new one, rw-rw-rw- restricted by the user's umask.
mode_t permissions_for(const std::filesystem::path& path) {
  struct stat old {};
  if (::stat(path.c_str(), &old) == 0) return old.st_mode & 07777U;
  // umask() reads the mask only by setting it, which would race with other threads; Linux reports it in this
  // file.
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

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

// Name of a new file in the folder of NAME: .NAME. and six characters, as mkostemp() chooses them.
constexpr std::string_view kRandomPart = "XXXXXX";

std::filesystem::path name_pattern(const std::filesystem::path& path) {
  return folder_of(path) / ("." + path.filename().string() + "." + std::string(kRandomPart));
}

constexpr int kMostNames = 1000;

// Global, since the files of all commands and modules pass here.
std::atomic<const std::atomic<bool>*> commits_end_with{nullptr};

/// Differs between processes and between calls.
std::string random_name(const std::filesystem::path& path, int attempt) {
  constexpr std::string_view kCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  auto bits = static_cast<std::uint64_t>(now.tv_nsec) * 2654435761U ^
              static_cast<std::uint64_t>(::getpid()) << 20U ^ static_cast<std::uint64_t>(attempt) * 7919U;
  std::string name = name_pattern(path).string();
  for (std::size_t k = name.size() - kRandomPart.size(); k < name.size(); ++k, bits /= kCharacters.size())
    name[k] = kCharacters[bits % kCharacters.size()];
  return name;
}

/// Removes files that killed programs left in the folder of `path`: files with the names above that no
/// program is writing.
void remove_abandoned(const std::filesystem::path& path) {
  const std::string pattern = name_pattern(path).filename().string();
  const std::string_view start = std::string_view(pattern).substr(0, pattern.size() - kRandomPart.size());
  std::error_code failed;
  for (auto it = std::filesystem::directory_iterator(folder_of(path), failed);
       !failed && it != std::filesystem::directory_iterator(); it.increment(failed)) {
    const std::string name = it->path().filename().string();
    if (name.size() != pattern.size() || !name.starts_with(start)) continue;
    const int descriptor = ::open(it->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    struct stat found {};
    if (::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) &&
        ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      ::unlink(it->path().c_str());
    ::close(descriptor);
  }
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void refuse_commits_after(const std::atomic<bool>* cancelled) noexcept { commits_end_with = cancelled; }

Result<void> check_commits_allowed() {
  const std::atomic<bool>* const cancelled = commits_end_with;
  if (cancelled != nullptr && *cancelled) return Work::interrupted();
  return {};
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  AtomicFile file;
  std::error_code none;
  file.path_ = std::filesystem::is_symlink(path, none) ? std::filesystem::weakly_canonical(path, none) : path;
  if (file.path_.empty()) file.path_ = path;
  if (takes_a_stream(file.path_)) {
    file.descriptor_ = ::open(file.path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.failure("cannot be written");
    file.is_stream_ = true;
    return file;
  }
  if (std::filesystem::is_directory(file.path_, none))
    return Error{ErrorCode::failed, "cannot be written: it is a folder", path.string()};
  remove_abandoned(file.path_);
  const std::filesystem::path folder = folder_of(file.path_);
  // A file without a name disappears with the program, however that ends.
  file.descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (file.descriptor_ >= 0) return file;
  if (!file.name_beside()) return file.failure("cannot be written");
  return file;
}

/// Creates a new file with a unique name. Its lock shows other processes that it is being written.
bool AtomicFile::name_beside() {
  while (true) {
    std::string beside = name_pattern(path_).string();
    descriptor_ = ::mkostemp(beside.data(), O_CLOEXEC);
    if (descriptor_ < 0) return false;
    beside_ = beside;
    struct stat now {};
    // Another process that found it before it was locked may have removed it as abandoned.
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor_, &now) == 0 && now.st_nlink > 0)
      return true;
    discard();
  }
}

/// Links the file without a name to one, because only a name can be renamed over the old file.
bool AtomicFile::link_beside() {
  const std::string opened = "/proc/self/fd/" + std::to_string(descriptor_);
  static_cast<void>(::flock(descriptor_, LOCK_EX | LOCK_NB));
  for (int attempt = 0; attempt < kMostNames; ++attempt) {
    const std::string beside = random_name(path_, attempt);
    if (::linkat(AT_FDCWD, opened.c_str(), AT_FDCWD, beside.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      beside_ = beside;
      return true;
    }
    if (errno != EEXIST) return false;
  }
  return false;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      beside_(std::exchange(other.beside_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      is_stream_(other.is_stream_) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this != &other) {
    discard();
    path_ = std::move(other.path_);
    beside_ = std::exchange(other.beside_, {});
    descriptor_ = std::exchange(other.descriptor_, -1);
    is_stream_ = other.is_stream_;
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
  if (auto allowed = check_commits_allowed(); !allowed) return allowed;
  return put_in_place();
}

Result<void> AtomicFile::put_in_place() {
  if (is_stream_) {
    discard();
    return {};
  }
  // Fails on a file system without permissions (a USB stick); the file is written all the same.
  static_cast<void>(::fchmod(descriptor_, permissions_for(path_)));
  if (::fsync(descriptor_) != 0) return failure("cannot be written");
  if (beside_.empty() && !link_beside()) return failure("cannot be written");
  // Closed only after renaming: its lock keeps other processes from removing it as abandoned.
  if (::rename(beside_.c_str(), path_.c_str()) != 0) return failure("cannot be replaced");
  beside_.clear();
  sync_folder(folder_of(path_));
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure("cannot be written");
  return {};
}

Result<void> check_room(const std::filesystem::path& path) {
  auto file = AtomicFile::create(path);
  if (!file) return std::move(file).error();
  // A page needs a block, which a full disk cannot allocate; smaller files may be stored in the folder
  // itself.
  constexpr std::array<std::byte, 4096> kPage{};
  return file->write(kPage);
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  auto file = AtomicFile::create(path);
  if (!file) return std::move(file).error();
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

}  // namespace palpable
