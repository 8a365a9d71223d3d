// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth_camera/openni_camera.hpp"

#include "palpable/sources/depth_camera/camera_pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

// OpenNI's C interface, as far as it is used: OniCAPI.h, OniCTypes.h, OniCEnums.h and OniCProperties.h
// of 2.2.
constexpr int kVersion = 2002;
constexpr int kOk = 0, kTimeOut = 102;
constexpr int kColourSensor = 2, kDepthSensor = 3;
constexpr int kMillimetres = 100, kTenthMillimetres = 101, kRgb = 200;
constexpr int kRegistration = 5, kDepthToColour = 1;
constexpr int kHorizontalView = 1, kVerticalView = 2, kMirroring = 7;

struct OniDeviceInfo {
  std::array<char, 256> uri, vendor, name;
  std::uint16_t usb_vendor, usb_product;
};
struct OniFrame {
  int bytes;
  void* data;
  int sensor;
  std::uint64_t timestamp_us;
  int index;
  int width, height;
  struct Mode {
    int format, width, height, rate_hz;
  } mode;
  int is_cropped, left, top;
  int stride;
};
using Handle = void*;

struct OpenNi {
  int (*oniInitialize)(int) = nullptr;
  void (*oniShutdown)() = nullptr;
  int (*oniGetDeviceList)(OniDeviceInfo**, int*) = nullptr;
  int (*oniReleaseDeviceList)(OniDeviceInfo*) = nullptr;
  int (*oniDeviceOpen)(const char*, Handle*) = nullptr;
  int (*oniDeviceClose)(Handle) = nullptr;
  int (*oniDeviceSetProperty)(Handle, int, const void*, int) = nullptr;
  int (*oniDeviceCreateStream)(Handle, int, Handle*) = nullptr;
  void (*oniStreamDestroy)(Handle) = nullptr;
  int (*oniStreamStart)(Handle) = nullptr;
  void (*oniStreamStop)(Handle) = nullptr;
  int (*oniStreamSetProperty)(Handle, int, const void*, int) = nullptr;
  int (*oniStreamGetProperty)(Handle, int, void*, int*) = nullptr;
  int (*oniWaitForAnyStream)(Handle*, int, int*, int) = nullptr;
  int (*oniStreamReadFrame)(Handle, OniFrame**) = nullptr;
  void (*oniFrameRelease)(OniFrame*) = nullptr;
  const char* (*oniGetExtendedError)() = nullptr;
};

Result<OpenNi> load(const std::string& file) {
  const auto library = SharedLibrary::open(file, {"libOpenNI2.so", "libOpenNI2.so.0"});
  if (!library) return library.error();
  OpenNi oni;
  Binder bind(*library);
  bind(oni.oniInitialize, "oniInitialize");
  bind(oni.oniShutdown, "oniShutdown");
  bind(oni.oniGetDeviceList, "oniGetDeviceList");
  bind(oni.oniReleaseDeviceList, "oniReleaseDeviceList");
  bind(oni.oniDeviceOpen, "oniDeviceOpen");
  bind(oni.oniDeviceClose, "oniDeviceClose");
  bind(oni.oniDeviceSetProperty, "oniDeviceSetProperty");
  bind(oni.oniDeviceCreateStream, "oniDeviceCreateStream");
  bind(oni.oniStreamDestroy, "oniStreamDestroy");
  bind(oni.oniStreamStart, "oniStreamStart");
  bind(oni.oniStreamStop, "oniStreamStop");
  bind(oni.oniStreamSetProperty, "oniStreamSetProperty");
  bind(oni.oniStreamGetProperty, "oniStreamGetProperty");
  bind(oni.oniWaitForAnyStream, "oniWaitForAnyStream");
  bind(oni.oniStreamReadFrame, "oniStreamReadFrame");
  bind(oni.oniFrameRelease, "oniFrameRelease");
  bind(oni.oniGetExtendedError, "oniGetExtendedError");
  if (auto bound = std::move(bind).bound(); !bound) return std::move(bound).error();
  return oni;
}

LibraryPixels pixels_of(const OniFrame& frame) {
  return {frame.data, frame.width, frame.height, static_cast<std::size_t>(std::max(0, frame.stride)),
          static_cast<std::size_t>(std::max(0, frame.bytes))};
}

class OpenNiCamera final : public DepthCameraLink {
 public:
  OpenNiCamera(const OpenNi& oni, std::chrono::milliseconds silence) : oni_(oni), silence_(silence) {}

  ~OpenNiCamera() override {
    for (const Handle stream : {depth_, colour_}) {
      if (stream == nullptr) continue;
      oni_.oniStreamStop(stream);
      oni_.oniStreamDestroy(stream);
    }
    if (device_ != nullptr) oni_.oniDeviceClose(device_);
    if (is_begun_) oni_.oniShutdown();
  }

  Result<void> open(const DepthCamera& camera) {
    if (oni_.oniInitialize(kVersion) != kOk) return fault("does not begin");
    is_begun_ = true;
    OniDeviceInfo* list = nullptr;
    int count = 0;
    if (oni_.oniGetDeviceList(&list, &count) != kOk) return fault("lists no cameras");
    std::string uri;
    if (list != nullptr && camera.number < count) {
      const auto& stated = list[camera.number].uri;
      uri.assign(stated.begin(), std::find(stated.begin(), stated.end(), '\0'));
    }
    oni_.oniReleaseDeviceList(list);
    if (uri.empty()) return no_such_camera(camera, count);
    if (oni_.oniDeviceOpen(uri.c_str(), &device_) != kOk) return fault("does not open the camera");
    if (oni_.oniDeviceCreateStream(device_, kDepthSensor, &depth_) != kOk) return fault("gives no depths");
    start_colours();
    unmirror(depth_);
    if (oni_.oniStreamStart(depth_) != kOk) return fault("does not start the depths");
    silence_.end();
    return {};
  }

  Result<std::optional<DepthFrame>> next(std::chrono::milliseconds longest) override {
    int which = 0;
    const int status = oni_.oniWaitForAnyStream(&depth_, 1, &which, static_cast<int>(longest.count()));
    if (status == kTimeOut) {
      if (auto checked = silence_.check(); !checked) return std::move(checked).error();
      return std::optional<DepthFrame>();
    }
    OniFrame* frame = nullptr;
    if (status != kOk || oni_.oniStreamReadFrame(depth_, &frame) != kOk || frame == nullptr)
      return fault("gives no more depths");
    auto depth = depth_of(*frame);
    const int index = frame->index;
    oni_.oniFrameRelease(frame);
    if (!depth) return std::move(depth).error();
    silence_.end();
    first_ = std::min(first_.value_or(index), index);
    return std::optional(DepthFrame{static_cast<std::uint64_t>(index - *first_),
                                    std::chrono::steady_clock::now(), *std::move(depth), newest_colours()});
  }

 private:
  Error fault(const char* what) const {
    const char* why = oni_.oniGetExtendedError();
    std::string reason = why == nullptr ? "" : why;
    reason.erase(std::find(reason.begin(), reason.end(), '\n'), reason.end());
    return invalid_input(reason.empty() ? std::string(what) : fmt::format("{}: {}", what, reason));
  }

  /// Pictures come as in a mirror unless told otherwise.
  void unmirror(Handle stream) const {
    const int off = 0;
    oni_.oniStreamSetProperty(stream, kMirroring, &off, sizeof off);
  }

  /// Colours are for the eye: a camera without them is touched all the same.
  void start_colours() {
    if (oni_.oniDeviceCreateStream(device_, kColourSensor, &colour_) != kOk) {
      colour_ = nullptr;
      return;
    }
    const int registration = kDepthToColour;
    is_registered_ =
        oni_.oniDeviceSetProperty(device_, kRegistration, &registration, sizeof registration) == kOk;
    unmirror(colour_);
    if (is_registered_ && oni_.oniStreamStart(colour_) == kOk) return;
    // Colours of other pixels than the depths' would show the wrong place.
    oni_.oniStreamDestroy(std::exchange(colour_, nullptr));
    is_registered_ = false;
  }

  Result<DepthMap> depth_of(const OniFrame& frame) const {
    const int format = frame.mode.format;
    if (format != kMillimetres && format != kTenthMillimetres)
      return invalid_input("sends depths in a form that is not read");
    auto depth_m = depth_of_pixels(pixels_of(frame), format == kMillimetres ? 1e-3 : 1e-4);
    if (!depth_m) return std::move(depth_m).error();
    return DepthMap{*std::move(depth_m), camera_of(frame)};
  }

  std::optional<Pinhole> camera_of(const OniFrame& frame) const {
    const auto view = [&](int property) {
      float angle = 0.0F;
      int size = sizeof angle;
      const Handle stream = is_registered_ ? colour_ : depth_;
      return oni_.oniStreamGetProperty(stream, property, &angle, &size) == kOk ? static_cast<double>(angle)
                                                                               : 0.0;
    };
    const double across = view(kHorizontalView), down = view(kVerticalView);
    constexpr double kLeast = 0.05, kMost = 3.0;
    if (!(across > kLeast && across < kMost && down > kLeast && down < kMost)) return std::nullopt;
    return Pinhole{0.5 * frame.width / std::tan(0.5 * across),
                   0.5 * frame.height / std::tan(0.5 * down),
                   0.5 * (frame.width - 1),
                   0.5 * (frame.height - 1),
                   frame.width,
                   frame.height};
  }

  std::optional<Image> newest_colours() {
    int which = 0;
    OniFrame* frame = nullptr;
    if (colour_ == nullptr || oni_.oniWaitForAnyStream(&colour_, 1, &which, 0) != kOk ||
        oni_.oniStreamReadFrame(colour_, &frame) != kOk || frame == nullptr)
      return std::nullopt;
    auto picture = frame->mode.format == kRgb ? picture_of_pixels(pixels_of(*frame)) : std::nullopt;
    oni_.oniFrameRelease(frame);
    return picture;
  }

  OpenNi oni_;
  bool is_begun_ = false;
  Handle device_ = nullptr, depth_ = nullptr, colour_ = nullptr;
  bool is_registered_ = false;
  std::optional<int> first_;
  Silence silence_;
};

}  // namespace

Result<std::unique_ptr<DepthCameraLink>> open_openni_camera(const DepthCamera& camera) {
  const auto oni = load(camera.library);
  if (!oni) return oni.error();
  auto link = std::make_unique<OpenNiCamera>(*oni, camera.silence);
  if (auto opened = link->open(camera); !opened) return std::move(opened).error();
  return std::unique_ptr<DepthCameraLink>(std::move(link));
}

}  // namespace palpable::sources
