// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth_camera/freenect_camera.hpp"

#include "palpable/sources/depth_camera/camera_pixels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <sys/time.h>

namespace palpable::sources {
namespace {

// libfreenect's interface, as far as it is used: libfreenect.h of 0.5.
constexpr int kCamera = 2;
constexpr int kSilent = 0;
constexpr int kMediumSize = 1, kRegisteredDepth = 4, kRgb = 0;
/// The size of FREENECT_RESOLUTION_MEDIUM, of registered depths and of colours.
constexpr int kWidth = 640, kHeight = 480;
/// Of the colour camera of a Kinect, nominally: the library states none.
constexpr double kFocal_px = 525.0;
constexpr std::size_t kRgbBytes = 3;

struct FrameMode {
  std::uint32_t reserved;
  int resolution;
  std::int32_t format;
  std::int32_t bytes;
  std::int16_t width, height;
  std::int8_t bits, padding, rate_hz, is_valid;
};
using Handle = void*;
using Callback = void (*)(Handle, void*, std::uint32_t);

struct Freenect {
  int (*freenect_init)(Handle*, void*) = nullptr;
  int (*freenect_shutdown)(Handle) = nullptr;
  void (*freenect_set_log_level)(Handle, int) = nullptr;
  void (*freenect_select_subdevices)(Handle, int) = nullptr;
  int (*freenect_num_devices)(Handle) = nullptr;
  int (*freenect_open_device)(Handle, Handle*, int) = nullptr;
  int (*freenect_close_device)(Handle) = nullptr;
  FrameMode (*freenect_find_depth_mode)(int, int) = nullptr;
  FrameMode (*freenect_find_video_mode)(int, int) = nullptr;
  int (*freenect_set_depth_mode)(Handle, FrameMode) = nullptr;
  int (*freenect_set_video_mode)(Handle, FrameMode) = nullptr;
  void (*freenect_set_depth_callback)(Handle, Callback) = nullptr;
  void (*freenect_set_video_callback)(Handle, Callback) = nullptr;
  int (*freenect_start_depth)(Handle) = nullptr;
  int (*freenect_start_video)(Handle) = nullptr;
  int (*freenect_stop_depth)(Handle) = nullptr;
  int (*freenect_stop_video)(Handle) = nullptr;
  int (*freenect_process_events_timeout)(Handle, timeval*) = nullptr;
};

Result<Freenect> load(const std::string& file) {
  const auto library = SharedLibrary::open(file, {"libfreenect.so", "libfreenect.so.0.5"});
  if (!library) return library.error();
  Freenect f;
  Binder bind(*library);
  bind(f.freenect_init, "freenect_init");
  bind(f.freenect_shutdown, "freenect_shutdown");
  bind(f.freenect_set_log_level, "freenect_set_log_level");
  bind(f.freenect_select_subdevices, "freenect_select_subdevices");
  bind(f.freenect_num_devices, "freenect_num_devices");
  bind(f.freenect_open_device, "freenect_open_device");
  bind(f.freenect_close_device, "freenect_close_device");
  bind(f.freenect_find_depth_mode, "freenect_find_depth_mode");
  bind(f.freenect_find_video_mode, "freenect_find_video_mode");
  bind(f.freenect_set_depth_mode, "freenect_set_depth_mode");
  bind(f.freenect_set_video_mode, "freenect_set_video_mode");
  bind(f.freenect_set_depth_callback, "freenect_set_depth_callback");
  bind(f.freenect_set_video_callback, "freenect_set_video_callback");
  bind(f.freenect_start_depth, "freenect_start_depth");
  bind(f.freenect_start_video, "freenect_start_video");
  bind(f.freenect_stop_depth, "freenect_stop_depth");
  bind(f.freenect_stop_video, "freenect_stop_video");
  bind(f.freenect_process_events_timeout, "freenect_process_events_timeout");
  if (auto bound = std::move(bind).bound(); !bound) return std::move(bound).error();
  return f;
}

class FreenectCamera final : public DepthCameraLink {
 public:
  FreenectCamera(const Freenect& functions, std::chrono::milliseconds silence)
      : f_(functions), silence_(silence) {}

  ~FreenectCamera() override {
    if (device_ != nullptr) {
      if (has_depths_) f_.freenect_stop_depth(device_);
      if (has_colours_) f_.freenect_stop_video(device_);
      f_.freenect_close_device(device_);
    }
    if (context_ != nullptr) f_.freenect_shutdown(context_);
  }

  Result<void> open(const DepthCamera& camera) {
    if (f_.freenect_init(&context_, nullptr) < 0) return invalid_input("does not begin");
    f_.freenect_set_log_level(context_, kSilent);
    f_.freenect_select_subdevices(context_, kCamera);
    const int count = f_.freenect_num_devices(context_);
    if (camera.number >= count) return no_such_camera(camera, count);
    if (f_.freenect_open_device(context_, &device_, camera.number) < 0) {
      device_ = nullptr;
      return invalid_input("is not opened: another program may use it, or you may not");
    }
    const FrameMode depths = f_.freenect_find_depth_mode(kMediumSize, kRegisteredDepth);
    if (!is_read(depths, sizeof(std::uint16_t)) || f_.freenect_set_depth_mode(device_, depths) < 0)
      return invalid_input("has no depths in the colour camera's picture");
    f_.freenect_set_depth_callback(device_, [](Handle, void* data, std::uint32_t) {
      if (running != nullptr) keep(running->depth_, data);
    });
    start_colours();
    has_depths_ = f_.freenect_start_depth(device_) >= 0;
    if (!has_depths_) return invalid_input("does not start the depths");
    silence_.end();
    return {};
  }

  Result<std::optional<DepthFrame>> next(std::chrono::milliseconds longest) override {
    const auto deadline = std::chrono::steady_clock::now() + longest;
    while (!depth_.is_new) {
      const auto left =
          std::chrono::duration_cast<std::chrono::microseconds>(deadline - std::chrono::steady_clock::now());
      if (left.count() <= 0) break;
      timeval wait{left.count() / 1000000, left.count() % 1000000};
      running = this;
      const int status = f_.freenect_process_events_timeout(context_, &wait);
      running = nullptr;
      if (status < 0) return invalid_input("answers no more: it may have been unplugged");
    }
    if (!depth_.is_new) {
      if (auto checked = silence_.check(); !checked) return std::move(checked).error();
      return std::optional<DepthFrame>();
    }
    depth_.is_new = false;
    silence_.end();
    auto depth_m = depth_of_pixels(pixels_of(depth_), 1e-3);
    if (!depth_m) return std::move(depth_m).error();
    constexpr Pinhole kColourCamera{kFocal_px,           kFocal_px, 0.5 * (kWidth - 1),
                                    0.5 * (kHeight - 1), kWidth,    kHeight};
    DepthFrame frame{
        depth_.count - 1, std::chrono::steady_clock::now(), {*std::move(depth_m), kColourCamera}, {}};
    if (std::exchange(colour_.is_new, false)) frame.colour = picture_of_pixels(pixels_of(colour_));
    return std::optional(std::move(frame));
  }

 private:
  /// The camera whose event loop this thread runs, in next(): the library calls back out of that only, and
  /// gives the device, of which this class knows nothing.
  static thread_local FreenectCamera* running;
  /// The newest frame of one kind.
  struct Kept {
    std::vector<std::byte> bytes;
    std::size_t bytes_a_pixel = 0;
    bool is_new = false;
    std::uint64_t count = 0;
  };

  static bool is_read(const FrameMode& mode, std::size_t bytes_a_pixel) {
    return mode.is_valid != 0 && mode.width == kWidth && mode.height == kHeight &&
           mode.bytes == static_cast<std::int32_t>(bytes_a_pixel * kWidth * kHeight);
  }
  static LibraryPixels pixels_of(const Kept& kept) {
    return {kept.bytes.data(), kWidth, kHeight, kept.bytes_a_pixel * kWidth, kept.bytes.size()};
  }
  static void keep(Kept& kept, const void* data) {
    const auto* bytes = static_cast<const std::byte*>(data);
    if (bytes == nullptr) return;
    kept.bytes.assign(bytes, bytes + kept.bytes_a_pixel * kWidth * kHeight);
    kept.is_new = true;
    ++kept.count;
  }

  void start_colours() {
    const FrameMode colours = f_.freenect_find_video_mode(kMediumSize, kRgb);
    if (!is_read(colours, kRgbBytes) || f_.freenect_set_video_mode(device_, colours) < 0) return;
    f_.freenect_set_video_callback(device_, [](Handle, void* data, std::uint32_t) {
      if (running != nullptr) keep(running->colour_, data);
    });
    has_colours_ = f_.freenect_start_video(device_) >= 0;
  }

  Freenect f_;
  Handle context_ = nullptr, device_ = nullptr;
  bool has_depths_ = false, has_colours_ = false;
  Kept depth_{{}, sizeof(std::uint16_t)};
  Kept colour_{{}, kRgbBytes};
  Silence silence_;
};

thread_local FreenectCamera* FreenectCamera::running = nullptr;

}  // namespace

Result<std::unique_ptr<DepthCameraLink>> open_freenect_camera(const DepthCamera& camera) {
  const auto functions = load(camera.library);
  if (!functions) return functions.error();
  auto link = std::make_unique<FreenectCamera>(*functions, camera.silence);
  if (auto opened = link->open(camera); !opened) return std::move(opened).error();
  return std::unique_ptr<DepthCameraLink>(std::move(link));
}

}  // namespace palpable::sources
