// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/stream/stream_camera.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/core/text/plain_text.hpp"
#include "palpable/sources/isolated/decoder_process.hpp"
#include "palpable/sources/live/frame_size.hpp"
#include "palpable/sources/stream/stream_protocol.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::sources {
namespace {

using stream::PartHeader;
using stream::PartKind;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

class StreamCamera final : public CameraLink {
 public:
  StreamCamera(pid_t process, Descriptor parts) : process_(process), parts_(std::move(parts)) {}
  ~StreamCamera() override { end(std::chrono::seconds(0)); }
  StreamCamera(const StreamCamera&) = delete;
  StreamCamera& operator=(const StreamCamera&) = delete;

  Result<std::optional<CameraFrame>> next(milliseconds longest) override {
    const auto deadline = Clock::now() + longest;
    std::optional<CameraFrame> newest;
    do {
      const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
      pollfd wait{parts_.number(), POLLIN, 0};
      ::poll(&wait, 1, static_cast<int>(std::clamp<milliseconds::rep>(left.count(), 0, 1000)));
      const bool is_open = receive();
      while (auto part = take_part()) {
        if (!*part) return std::move(*part).error();
        if (**part) newest = std::move(**part);
      }
      // The pictures before the last part are of use.
      if (newest) return newest;
      if (ended_) return *ended_;
      if (!is_open) return why_closed();
      if (Clock::now() - last_ > kPatience)
        return invalid_input(fmt::format("has sent nothing for {} s", kPatience.count()));
    } while (Clock::now() < deadline);
    return newest;
  }

 private:
  /// The process's own limits are shorter.
  static constexpr std::chrono::seconds kPatience{20};

  using Part = Result<std::optional<CameraFrame>>;

  /// Waits for the process's end, and ends it if that takes longer; what it was, if it ended by itself.
  std::optional<int> end(std::chrono::seconds patience) {
    if (process_ < 0) return std::nullopt;
    const auto ended = isolated::wait_for_end(std::exchange(process_, -1), std::move(parts_), patience);
    return ended.in_time ? ended.status : std::nullopt;
  }

  /// The process closed its pipe without a reason.
  Error why_closed() {
    const auto status = end(std::chrono::seconds(1));
    if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGKILL)
      return {ErrorCode::failed,
              "lost its decoder, which was ended from outside, such as for want of memory",
              {}};
    return came_ ? invalid_input("sent something on which its decoder crashed") : incomplete();
  }

  /// The process did not begin.
  static Error incomplete() {
    return {ErrorCode::failed,
            "cannot be read: palpable-stream-decoder, which reads network streams, did not begin: the "
            "installation of Palpable is incomplete, or of two versions",
            {}};
  }

  /// Reads what is there; false: the process has closed its end.
  bool receive() {
    constexpr std::size_t kAtOnce = std::size_t{1} << 20U;
    for (;;) {
      const std::size_t before = received_.size();
      received_.resize(before + kAtOnce);
      const ssize_t count = ::read(parts_.number(), received_.data() + before, kAtOnce);
      received_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      if (count > 0) last_ = Clock::now();
      if (count < 0 && errno == EINTR) continue;
      if (count < static_cast<ssize_t>(kAtOnce)) return count > 0 || (count < 0 && errno == EAGAIN);
      if (received_.size() > kMostWaiting) return true;
    }
  }

  /// The next whole part, of which only pictures are given; nullopt: more is to be read first.
  std::optional<Part> take_part() {
    PartHeader header;
    if (received_.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, received_.data(), sizeof header);
    if (!is_valid(header)) return Part(invalid_input("sent something that took its decoder over"));
    const auto whole = sizeof header + static_cast<std::size_t>(header.bytes);
    if (received_.size() < whole) return std::nullopt;
    const auto content = std::span(received_).subspan(sizeof header, static_cast<std::size_t>(header.bytes));
    Part part(std::optional<CameraFrame>{});
    came_ = true;
    if (header.kind == PartKind::ended)
      ended_ = invalid_input(plain_name({reinterpret_cast<const char*>(content.data()), content.size()}));
    if (header.kind == PartKind::picture) part = std::optional(picture_of_part(header, content));
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(whole));
    return part;
  }

  CameraFrame picture_of_part(const PartHeader& header, std::span<const std::byte> rows) {
    // The process may state any number and time.
    number_ = std::max(number_ + 1, std::min(header.number + 1, number_ + kMostSkipped));
    const auto now = Clock::now();
    const auto stated = Clock::time_point(std::chrono::nanoseconds(header.arrival_ns));
    const auto arrival = std::clamp(stated, now - std::chrono::seconds(1), now);
    return {number_ - 1, arrival, CameraCoding::rgb, header.width, header.height, {rows.begin(), rows.end()}};
  }

  static bool is_valid(const PartHeader& header) {
    switch (header.kind) {
      case PartKind::begun:
        return header.bytes == 0;
      case PartKind::ended:
        return header.bytes <= stream::kLongestReason;
      case PartKind::picture:
        return check_frame_size(header.width, header.height) &&
               header.bytes ==
                   3 * static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
    }
    return false;
  }

  static constexpr std::size_t kMostWaiting = std::size_t{64} << 20U;
  static constexpr std::uint64_t kMostSkipped = 10000;

  /// -1: it was waited for.
  pid_t process_;
  Descriptor parts_;
  std::vector<std::byte> received_;
  std::optional<Error> ended_;
  bool came_ = false;
  std::uint64_t number_ = 0;
  Clock::time_point last_ = Clock::now();
};

Error cannot_start(const std::string& why) {
  return {ErrorCode::failed, "cannot be read: its decoder cannot be started: " + why, {}};
}

/// Writes the request into a pipe, which holds as much.
bool write_request(int pipe, const StreamAddress& address) {
  const std::string request = (address.takes_any_certificate ? "1" : "0") + address.url;
  return ::write(pipe, request.data(), request.size()) == static_cast<ssize_t>(request.size());
}

}  // namespace

Result<std::unique_ptr<CameraLink>> connect_stream_camera(const StreamAddress& address) {
  if (address.url.size() > stream::kLongestAddress) return invalid_input("is too long an address");
  const auto program =
      helper_program("palpable-stream-decoder", "PALPABLE_STREAM_DECODER", PALPABLE_DECODER_FOLDER);
  if (!program)
    return Error{ErrorCode::failed,
                 "cannot be read: the installation of Palpable is incomplete: " + program.error().message,
                 {}};
  auto request = make_pipe();
  auto parts = make_pipe();
  if (!request || !parts) return cannot_start("too many files are open");
  if (!write_request(request->second.number(), address)) return cannot_start("its pipe takes nothing");
  ::fcntl(parts->first.number(), F_SETFL, O_NONBLOCK);
  // A picture is read in a few parts; the system may refuse.
  constexpr int kPipeBytes = 1 << 20;
  ::fcntl(parts->first.number(), F_SETPIPE_SZ, kPipeBytes);
  static_assert(stream::kRequestDescriptor == 3 && stream::kPartsDescriptor == 4);
  const auto process = start_child(*program, {std::string(stream::kProtocolVersion)},
                                   std::array{request->first.number(), parts->second.number()});
  if (!process) return cannot_start(process.error().message);
  return std::unique_ptr<CameraLink>(std::make_unique<StreamCamera>(*process, std::move(parts->first)));
}

}  // namespace palpable::sources
