// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/isolated/isolated.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/core/system/memory.hpp"
#include "palpable/sources/isolated/decoder_process.hpp"
#include "palpable/sources/isolated/protocol.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::sources::isolated {
namespace {

namespace fs = std::filesystem;

/// A decoder program, and the environment variable that names another one in its place.
struct Program {
  const char* name;
  const char* variable;
};

// One for each external library that takes long to load.
constexpr Program kCalibration{"palpable-calibration-decoder", "PALPABLE_CALIBRATION_DECODER"};
constexpr Program kHeif{"palpable-heif-decoder", "PALPABLE_HEIF_DECODER"};
constexpr Program kMap{"palpable-map-decoder", "PALPABLE_MAP_DECODER"};
constexpr Program kMesh{"palpable-mesh-decoder", "PALPABLE_MESH_DECODER"};
constexpr Program kPicture{"palpable-picture-decoder", "PALPABLE_PICTURE_DECODER"};
constexpr Program kVideo{"palpable-video-decoder", "PALPABLE_VIDEO_DECODER"};

struct JobEntry {
  Job job;
  std::string_view name;
  Program program;
};

/// In the order of Job.
constexpr std::array<JobEntry, 13> kJobs{{{Job::obj, "obj", kMesh},
                                          {Job::stl, "stl", kMesh},
                                          {Job::glb, "glb", kMesh},
                                          {Job::tiff, "tiff", kPicture},
                                          {Job::webp, "webp", kPicture},
                                          {Job::exr, "exr", kPicture},
                                          {Job::exr_depth, "exr-depth", kPicture},
                                          {Job::heif, "heif", kHeif},
                                          {Job::heif_depth, "heif-depth", kHeif},
                                          {Job::heif_announces_depth, "heif-announces-depth", kHeif},
                                          {Job::opencv_calibration, "opencv-calibration", kCalibration},
                                          {Job::map_extract, "map-extract", kMap},
                                          {Job::video, "video", kVideo}}};

const JobEntry& entry_of(Job job) { return kJobs[static_cast<std::size_t>(job)]; }

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;

Error cannot_start(const std::string& why) {
  return {ErrorCode::failed, "cannot be read: its decoder cannot be started: " + why, {}};
}

std::string reason_of(int number) { return std::generic_category().message(number); }

/// For bytes that are in no memory file yet.
Result<SharedBytes> copied(std::span<const std::byte> file) {
  auto writer = SharedBytes::Writer::begin();
  if (!writer) return std::move(writer).error();
  if (auto put = writer->put(file); !put) return std::move(put).error();
  return std::move(*writer).sealed();
}

Result<fs::path> decoder_program(Job job) {
  const auto& [name, variable] = entry_of(job).program;
  auto program = helper_program(name, variable, PALPABLE_DECODER_FOLDER);
  if (program) return program;
  return Error{
      ErrorCode::failed,
      fmt::format("cannot be read: the installation of Palpable is incomplete: the program {}, which "
                  "reads this kind of file, cannot be used: {}",
                  name, program.error().message),
      {}};
}

Error gives_too_much() {
  return invalid_input("is damaged or too large: it gives more than its size explains");
}

/// Why the program did not even begin: "ended with 127 before it began to read".
std::string end_before_begin(const DecoderEnd& end) {
  constexpr int kNotLoaded = 127;
  if (!end.in_time) return "did not begin to read in time";
  if (!end.status) return "ended, and the system did not say how";
  if (WIFSIGNALED(*end.status))
    return fmt::format("crashed before it began to read (signal {})", WTERMSIG(*end.status));
  return fmt::format("ended with {} before it began to read{}", WEXITSTATUS(*end.status),
                     WEXITSTATUS(*end.status) == kNotLoaded ? ", since the system could not load it" : "");
}

/// The file is not at fault.
Error incomplete(const fs::path& program, const std::string& what) {
  std::string sentence =
      fmt::format("cannot be read: its decoder {} {}: the installation of Palpable is incomplete",
                  program.string(), what);
  if (const auto most = address_space_limit_bytes())
    sentence += fmt::format(", or the limit of this shell is too low (ulimit -v, {} MiB)", *most / kMiB);
  return {ErrorCode::failed, std::move(sentence), {}};
}

Result<void> judge(const DecoderEnd& end, const fs::path& program, const Limits& limits) {
  const auto& status = end.status;
  if (status && WIFEXITED(*status)) switch (WEXITSTATUS(*status)) {
      case kWrongVersion:
        return incomplete(program, "is of another version");
      case kNotConfined:
        return cannot_start("it cannot limit itself");
      case kNoThread:
        return cannot_start("the system gives it no further thread (ulimit -u)");
      case kNoInput:
        return cannot_start("there is not enough memory for it and the file");
      default:
        break;
    }
  const bool overran = !end.in_time || (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGXCPU);
  if (!end.began) return incomplete(program, end_before_begin(end));
  if (overran)
    return invalid_input(fmt::format("is damaged or too large: it was not read within {} s of processor time",
                                     limits.processor_time.count()));
  if (!status) return cannot_start("its end was not reported");
  if (WIFSIGNALED(*status) && WTERMSIG(*status) == SIGKILL)
    return invalid_input("is damaged or too large: the system ended its decoder");
  if (WIFSIGNALED(*status))
    return invalid_input(fmt::format("is damaged: its decoder crashed on it (signal {})", WTERMSIG(*status)));
  switch (WEXITSTATUS(*status)) {
    case kReplied:
      return {};
    case kNotWritten:
      return gives_too_much();
    default:
      return invalid_input(fmt::format("is damaged: its decoder ended with {}", WEXITSTATUS(*status)));
  }
}

Result<Reply> mapped(int reply, std::uint64_t most_bytes) {
  struct stat now {};
  if (::fstat(reply, &now) != 0 || now.st_size <= 0)
    return invalid_input("is damaged: its decoder gave nothing");
  if (static_cast<std::uint64_t>(now.st_size) > most_bytes) return gives_too_much();
  const auto size = static_cast<std::size_t>(now.st_size);
  void* begin = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, reply, 0);
  if (begin == MAP_FAILED) return cannot_start(reason_of(errno));
  return Reply(begin, size);
}

}  // namespace

std::string_view name_of(Job job) { return entry_of(job).name; }

std::optional<Job> job_from(std::string_view name) {
  for (const JobEntry& entry : kJobs)
    if (entry.name == name) return entry.job;
  return std::nullopt;
}

Limits limits_of(Job job, std::size_t file_bytes) {
  const std::uint64_t mebibytes = file_bytes / kMiB + 1;
  Limits limits;
  // Shared libraries and the allocator's own arenas.
  constexpr std::uint64_t kBase = 768 * kMiB;
  switch (job) {
    case Job::obj:
    case Job::stl:
    case Job::glb: {
      // A triangle takes about 20 bytes in a file and 150 in Assimp's structures.
      constexpr std::uint64_t kMemory = 24, kResult = 16;
      limits.memory_bytes = kBase + kMemory * kMiB * mebibytes;
      limits.result_bytes = 64 * kMiB + kResult * kMiB * mebibytes;
      break;
    }
    case Job::opencv_calibration:
      limits.memory_bytes = kBase;
      limits.result_bytes = 16 * kMiB;
      break;
    case Job::video:
      // Returned frames, and those that the codec keeps; a short file may contain a long video.
      limits.memory_bytes = kBase + 3072 * kMiB;
      limits.result_bytes = 1300 * kMiB;
      break;
    default:
      // kMaxPixels of four floats, twice: in the library's and in this program's format.
      limits.memory_bytes = kBase + 3072 * kMiB;
      limits.result_bytes = 1040 * kMiB;
  }
  // Not more than the machine has left: for the user, the child's memory is memory of this program.
  if (const auto available = available_memory_bytes())
    limits.memory_bytes =
        std::min<std::uint64_t>(limits.memory_bytes, std::max<std::uint64_t>(*available, kBase));
  constexpr std::uint64_t kStart = 8, kVideoStart = 60;
  limits.processor_time = std::chrono::seconds((job == Job::video ? kVideoStart : kStart) + mebibytes);
  limits.time = 3 * limits.processor_time;
  return limits;
}

Reply::Reply(Reply&& other) noexcept
    : begin_(std::exchange(other.begin_, nullptr)), size_(std::exchange(other.size_, 0)) {}

Reply& Reply::operator=(Reply&& other) noexcept {
  std::swap(begin_, other.begin_);
  std::swap(size_, other.size_);
  return *this;
}

Reply::~Reply() {
  if (begin_ != nullptr) ::munmap(const_cast<void*>(begin_), size_);
}

Result<Reply> decode(Job job, FileView file, const Limits& limits) {
  if (file.bytes().empty()) return invalid_input("is empty");
  const auto program = decoder_program(job);
  if (!program) return program.error();
  std::optional<SharedBytes> copy;
  if (file.descriptor() < 0) {
    auto made = copied(file);
    if (!made) return cannot_start(made.error().message);
    file = copy.emplace(*std::move(made));
  }
  const Descriptor reply = passable(Descriptor(::memfd_create("palpable-reply", MFD_CLOEXEC)));
  if (reply.number() < 0) return cannot_start(reason_of(errno));
  auto pipe = make_pipe();
  if (!pipe) return cannot_start(pipe.error().message);
  auto& [alive, its_end] = *pipe;
  static_assert(kInputDescriptor == 3 && kReplyDescriptor == 4 && kAliveDescriptor == 5);
  const auto process = start_child(
      *program,
      {std::string(kProtocolVersion), std::string(name_of(job)), std::to_string(limits.memory_bytes),
       std::to_string(limits.result_bytes), std::to_string(limits.processor_time.count())},
      std::array{file.descriptor(), reply.number(), its_end.number()});
  if (!process) {
    const bool is_short_of = errno == EAGAIN || errno == ENOMEM || errno == EMFILE || errno == ENFILE;
    const std::string& why = process.error().message;
    return is_short_of ? cannot_start(why) : incomplete(*program, "cannot be started: " + why);
  }
  its_end.close();
  const DecoderEnd end = wait_for_end(*process, std::move(alive), limits.time);
  if (auto good = judge(end, *program, limits); !good) return std::move(good).error();
  return mapped(reply.number(), limits.result_bytes);
}

Result<Reply> decode(Job job, FileView file) {
  return decode(job, file, limits_of(job, file.bytes().size()));
}

}  // namespace palpable::sources::isolated
