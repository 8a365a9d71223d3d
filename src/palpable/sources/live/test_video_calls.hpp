// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/live/video_calls.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <linux/videodev2.h>

// For tests only: a camera with faults on command.
namespace palpable::sources {

/// Stands in for a machine with one camera, /dev/video2.
class FakeCamera final : public VideoCalls {
 public:
  /// The coding, pixels and name of the camera, and whether it is one.
  std::uint32_t coding = V4L2_PIX_FMT_MJPEG;
  std::uint32_t width = 320, height = 96;
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  /// The error number of the next calls of this request; of opening (0).
  std::map<unsigned long, int> faults;
  /// The pictures that are to come; an empty one is marked as damaged.
  std::deque<std::string> pictures;
  /// What it was set to.
  std::uint32_t rate_hz = 0;
  bool is_on = false;
  int open_count = 0, mapped = 0;

  int open(const char* path) override {
    if (faults.contains(0)) return fail(faults[0]);
    if (std::string(path) != "/dev/video2") return fail(ENOENT);
    ++open_count;
    return 7;
  }
  void close(int /*descriptor*/) override { --open_count; }
  void* map(int /*descriptor*/, std::size_t bytes, std::size_t offset) override {
    ++mapped;
    auto& buffer = buffers_.at(offset);
    buffer.resize(bytes);
    return buffer.data();
  }
  void unmap(void* /*begin*/, std::size_t /*bytes*/) override { --mapped; }
  void wait(int /*descriptor*/, std::chrono::milliseconds longest) override {
    if (pictures.empty()) std::this_thread::sleep_for(longest);
  }
  int control(int /*descriptor*/, unsigned long request, void* argument) override {
    if (faults.contains(request)) return fail(faults[request]);
    switch (request) {
      case VIDIOC_QUERYCAP: {
        auto& can = *static_cast<v4l2_capability*>(argument);
        std::strncpy(reinterpret_cast<char*>(can.card), "Test camera", sizeof can.card);
        can.capabilities = V4L2_CAP_DEVICE_CAPS;
        can.device_caps = capabilities;
        return 0;
      }
      case VIDIOC_G_FMT:
      case VIDIOC_S_FMT: {
        auto& pixels = static_cast<v4l2_format*>(argument)->fmt.pix;
        pixels.pixelformat = coding;
        pixels.width = width;
        pixels.height = height;
        return 0;
      }
      case VIDIOC_S_PARM:
        rate_hz = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe.denominator;
        return 0;
      case VIDIOC_STREAMON:
      case VIDIOC_STREAMOFF:
        is_on = request == VIDIOC_STREAMON;
        return 0;
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        constexpr std::uint32_t kBytes = 1U << 17U;
        buffer.length = kBytes;
        buffer.m.offset = buffer.index;
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return fill(*static_cast<v4l2_buffer*>(argument));
      default:
        return 0;
    }
  }

 private:
  static int fail(int why) {
    errno = why;
    return -1;
  }
  int fill(v4l2_buffer& buffer) {
    if (pictures.empty() || queued_.empty()) return fail(EAGAIN);
    const std::string picture = pictures.front();
    pictures.pop_front();
    buffer.index = queued_.front();
    queued_.pop_front();
    std::memcpy(buffers_.at(buffer.index).data(), picture.data(), picture.size());
    buffer.bytesused = static_cast<std::uint32_t>(picture.size());
    buffer.flags = picture.empty() ? V4L2_BUF_FLAG_ERROR : 0;
    if (picture.empty()) buffer.bytesused = 1;
    return 0;
  }

  std::array<std::vector<std::byte>, 4> buffers_;
  std::deque<std::uint32_t> queued_;
};

}  // namespace palpable::sources
