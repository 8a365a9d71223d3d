// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/video_device.hpp"

#include "palpable/core/picture/image.hpp"
#include "palpable/core/system/system_failure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <linux/videodev2.h>

namespace palpable::sources {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// An open device, closed at the end.
class Opened {
 public:
  Opened(VideoCalls& calls, int number)
      : calls_(&calls), descriptor_(calls.open(fmt::format("/dev/video{}", number).c_str())) {}
  ~Opened() {
    if (descriptor_ >= 0) calls_->close(descriptor_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  explicit operator bool() const { return descriptor_ >= 0; }
  int number() const { return descriptor_; }
  VideoCalls& calls() const { return *calls_; }
  template <class T>
  bool control(unsigned long request, T& argument) const {
    return calls_->control(descriptor_, request, &argument) >= 0;
  }

 private:
  VideoCalls* calls_;
  int descriptor_;
};

/// The camera's name; nullopt if the device is no camera.
std::optional<std::string> camera_name(const Opened& device) {
  v4l2_capability can{};
  if (!device.control(VIDIOC_QUERYCAP, can)) return std::nullopt;
  const auto own = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  if ((own & V4L2_CAP_VIDEO_CAPTURE) == 0 || (own & V4L2_CAP_STREAMING) == 0) return std::nullopt;
  const auto* begin = reinterpret_cast<const char*>(can.card);
  return std::string(begin, std::find(begin, begin + sizeof can.card, '\0'));
}

/// What a failed call says of the camera.
Error failure(int why) {
  switch (why) {
    case EBUSY:
      return invalid_input("is used by another program");
    case EACCES:
    case EPERM:
      return invalid_input("may not be opened; the group video has this right");
    case ENODEV:
    case ENXIO:
      return invalid_input("was unplugged");
    case ENOSPC:
      return invalid_input("gets no room on its USB bus; a smaller size or another socket would help");
    default:
      return invalid_input("has a fault (" + system_failure(why).message + ")");
  }
}

std::uint32_t code_of(CameraCoding coding) {
  return coding == CameraCoding::jpeg ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_YUYV;
}

/// The format as the camera took it; nullopt if it has no such coding.
Result<std::optional<v4l2_pix_format>> set_coding(const Opened& opened, const VideoDevice& device,
                                                  CameraCoding coding) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (!opened.control(VIDIOC_G_FMT, format)) return failure(errno);
  if (device.width > 0) {
    format.fmt.pix.width = static_cast<std::uint32_t>(device.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(device.height);
  }
  format.fmt.pix.pixelformat = code_of(coding);
  format.fmt.pix.field = V4L2_FIELD_ANY;
  format.fmt.pix.bytesperline = 0;
  if (!opened.control(VIDIOC_S_FMT, format)) {
    if (errno == EINVAL) return std::optional<v4l2_pix_format>();
    return failure(errno);
  }
  if (format.fmt.pix.pixelformat != code_of(coding)) return std::optional<v4l2_pix_format>();
  return std::optional(format.fmt.pix);
}

/// Sets coding, size and rate. Errors: as open_video_device().
Result<std::pair<CameraCoding, v4l2_pix_format>> set_up(const Opened& opened, const VideoDevice& device) {
  for (const auto coding : {CameraCoding::jpeg, CameraCoding::yuyv}) {
    if (device.coding && *device.coding != coding) continue;
    const auto set = set_coding(opened, device, coding);
    if (!set) return set.error();
    if (!*set) continue;
    const auto width = static_cast<int>((*set)->width), height = static_cast<int>((*set)->height);
    if (device.width > 0 && (width != device.width || height != device.height))
      return invalid_input(fmt::format("gives {} pixels, not {}", size_text(width, height),
                                       size_text(device.width, device.height)));
    if (coding == CameraCoding::yuyv && (*set)->bytesperline > 2 * (*set)->width)
      return invalid_input("leaves gaps between its rows; format=mjpeg would help");
    if (device.rate_hz > 0) {
      v4l2_streamparm rate{};
      rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
      rate.parm.capture.timeperframe = {1, static_cast<std::uint32_t>(device.rate_hz)};
      // A camera without a choice of rates keeps its own.
      static_cast<void>(opened.control(VIDIOC_S_PARM, rate));
    }
    return std::pair(coding, **set);
  }
  return invalid_input(device.coding ? "does not have this format"
                                     : "sends neither MJPEG nor YUYV, which are needed");
}

class VideoLink final : public CameraLink {
 public:
  VideoLink(VideoCalls& calls, int number, milliseconds silence)
      : device_(calls, number), silence_(silence) {}
  ~VideoLink() override {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (is_on_) static_cast<void>(device_.control(VIDIOC_STREAMOFF, type));
    for (const auto& buffer : buffers_) device_.calls().unmap(buffer.begin, buffer.bytes);
  }

  const Opened& device() const { return device_; }

  Result<void> start(CameraCoding coding, const v4l2_pix_format& format) {
    coding_ = coding;
    width_ = static_cast<int>(format.width);
    height_ = static_cast<int>(format.height);
    v4l2_requestbuffers asked{};
    constexpr std::uint32_t kBuffers = 4;
    asked.count = kBuffers;
    asked.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    asked.memory = V4L2_MEMORY_MMAP;
    if (!device_.control(VIDIOC_REQBUFS, asked)) return failure(errno);
    for (std::uint32_t k = 0; k < asked.count; ++k)
      if (auto shared = share(k); !shared) return shared;
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (buffers_.empty() || !device_.control(VIDIOC_STREAMON, type)) return failure(errno);
    is_on_ = true;
    last_ = Clock::now();
    return {};
  }

  Result<std::optional<CameraFrame>> next(milliseconds longest) override {
    device_.calls().wait(device_.number(), longest);
    std::optional<CameraFrame> newest;
    // No more than there are buffers, should a driver fill them as fast as they are returned.
    for (std::size_t k = 0; k < buffers_.size(); ++k) {
      v4l2_buffer buffer = blank(0);
      if (!device_.control(VIDIOC_DQBUF, buffer)) {
        if (errno == EAGAIN) break;
        return failure(errno);
      }
      if (auto frame = frame_in(buffer)) newest = std::move(frame);
      if (!device_.control(VIDIOC_QBUF, buffer)) return failure(errno);
    }
    if (!newest && Clock::now() - last_ > silence_)
      return invalid_input(
          fmt::format("has sent nothing for {:.1f} s", std::chrono::duration<double>(silence_).count()));
    return newest;
  }

 private:
  struct Buffer {
    void* begin = nullptr;
    std::size_t bytes = 0;
  };

  static v4l2_buffer blank(std::uint32_t index) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
  }

  Result<void> share(std::uint32_t index) {
    v4l2_buffer buffer = blank(index);
    if (!device_.control(VIDIOC_QUERYBUF, buffer)) return failure(errno);
    void* begin = device_.calls().map(device_.number(), buffer.length, buffer.m.offset);
    if (begin == nullptr) return failure(errno);
    buffers_.push_back({begin, buffer.length});
    if (!device_.control(VIDIOC_QBUF, buffer)) return failure(errno);
    return {};
  }

  /// The picture in a buffer that the driver has filled; nullopt for none, or one that is marked as damaged.
  std::optional<CameraFrame> frame_in(const v4l2_buffer& buffer) {
    last_ = Clock::now();
    if (buffer.index >= buffers_.size() || buffer.bytesused == 0 || (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0)
      return std::nullopt;
    const auto& shared = buffers_[buffer.index];
    const auto* begin = static_cast<const std::byte*>(shared.begin);
    const auto bytes = std::min<std::size_t>(buffer.bytesused, shared.bytes);
    return CameraFrame{count_++, last_, coding_, width_, height_, {begin, begin + bytes}};
  }

  Opened device_;
  milliseconds silence_;
  CameraCoding coding_ = CameraCoding::jpeg;
  int width_ = 0, height_ = 0;
  std::vector<Buffer> buffers_;
  bool is_on_ = false;
  Clock::time_point last_;
  std::uint64_t count_ = 0;
};

}  // namespace

std::string listed_cameras(VideoCalls& calls) {
  std::string list;
  for (int number = 0; number <= kMostVideoDevice; ++number) {
    const Opened device(calls, number);
    const auto name = device ? camera_name(device) : std::nullopt;
    if (name) list += fmt::format("{}camera:{} ({})", list.empty() ? "" : ", ", number, *name);
  }
  return list.empty() ? "none" : list;
}

Result<std::unique_ptr<CameraLink>> open_video_device(const VideoDevice& device, VideoCalls& calls,
                                                      milliseconds silence) {
  auto link = std::make_unique<VideoLink>(calls, device.number, silence);
  const Opened& opened = link->device();
  const int why = errno;
  if (!opened && why != ENOENT && why != ENODEV && why != ENXIO) return failure(why);
  if (!opened || !camera_name(opened))
    return invalid_input(fmt::format("is no camera of this machine; cameras: {}", listed_cameras(calls)));
  const auto format = set_up(opened, device);
  if (!format) return format.error();
  if (auto started = link->start(format->first, format->second); !started) return std::move(started).error();
  return std::unique_ptr<CameraLink>(std::move(link));
}

}  // namespace palpable::sources
