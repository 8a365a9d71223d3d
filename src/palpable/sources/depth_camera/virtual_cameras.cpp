// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The libraries of three makers of depth cameras in one, for tests: what OpenNI 2, libfreenect and
// librealsense export, as far as the program calls it, with a camera behind that sees a board, 1 m away, its
// right half 0.8 m away, and nothing in the top row. Colours: red to the left, green to the right. It comes
// as in a mirror until it is told otherwise, as OpenNI's does.
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

#include <sys/time.h>

namespace {

constexpr int kWidth = 640, kHeight = 480;

/// What tests set; one thread.
struct State {
  int cameras = 1;
  /// Frames until the camera is unplugged; negative: never.
  int frames = -1;
  /// As VirtualFault of the tests: 0 none, 1 no data, 2 another form of depths, 3 a huge size, 4 a short
  /// block, 5 no colours, 6 nothing comes.
  int fault = 0;
  bool is_mirrored = true;
  bool is_registered = false;
  int number = 0;
  /// Handles that were given and not taken back.
  int open = 0;
};
State state;

std::vector<std::uint16_t> depths() {
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(kWidth) * kHeight);
  for (int y = 1; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool is_right = (x >= kWidth / 2) != state.is_mirrored;
      pixels[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)] = is_right ? 800 : 1000;
    }
  return pixels;
}

std::vector<std::uint8_t> colours() {
  std::vector<std::uint8_t> pixels(std::size_t{3} * kWidth * kHeight);
  for (std::size_t k = 0; k < pixels.size() / 3; ++k)
    pixels[3 * k + ((static_cast<int>(k % kWidth) >= kWidth / 2) != state.is_mirrored ? 1U : 0U)] = 255;
  return pixels;
}

enum class Came { frame, nothing, lost };
/// Waits for a frame as a camera of 500 a second gives them.
Came wait(int longest_ms) {
  constexpr int kPeriod_ms = 2;
  if (state.frames == 0) return Came::lost;
  const bool comes = state.fault != 6 && longest_ms >= kPeriod_ms;
  std::this_thread::sleep_for(std::chrono::milliseconds(comes ? kPeriod_ms : longest_ms));
  if (!comes) return Came::nothing;
  if (state.frames > 0) --state.frames;
  // Every second frame is missed, as at a busy program.
  state.number += 2;
  return Came::frame;
}

void* handle() {
  ++state.open;
  return &state;
}
int given(void** to) {
  *to = handle();
  return 0;
}
void taken_back() { --state.open; }

struct VirtualDevice {
  std::array<char, 256> uri, vendor, name;
  std::uint16_t usb_vendor, usb_product;
};

struct VirtualOniFrame {
  int bytes;
  void* data;
  int sensor;
  std::uint64_t timestamp_us;
  int index, width, height;
  std::array<int, 4> mode;
  int is_cropped, left, top, stride;
  std::vector<std::uint16_t> depths = {};
  std::vector<std::uint8_t> colours = {};
};

// Streams are told apart by the address of a place: 0 depth, 1 colours.
std::array<char, 2> streams;

struct VirtualMode {
  std::uint32_t reserved;
  int resolution;
  std::int32_t format, bytes;
  std::int16_t width, height;
  std::int8_t bits, padding, rate_hz, is_valid;
};

using Callback = void (*)(void*, void*, std::uint32_t);
std::array<Callback, 2> callbacks;

VirtualMode mode(int resolution, int format, int bytes_a_pixel) {
  const bool is_known = resolution == 1 && state.fault != 2;
  return {0, resolution, format, bytes_a_pixel * kWidth * kHeight,          kWidth, kHeight,
          0, 0,          30,     static_cast<std::int8_t>(is_known ? 1 : 0)};
}

struct VirtualIntrinsics {
  int width, height;
  float ppx, ppy, fx, fy;
  int model;
  std::array<float, 5> coefficients;
};

/// A set of frames (stream 0), or one of them.
struct VirtualRsFrame {
  int stream = 0;
  std::vector<std::uint16_t> depths = {};
  std::vector<std::uint8_t> colours = {};
};

bool has_colours, is_aligned;
std::array<char, 3> profiles;

int fail(void** error) {
  *error = handle();
  return 0;
}

VirtualRsFrame* in_queue;

}  // namespace

extern "C" {

void virtual_cameras_set(int cameras, int frames, int fault) {
  const int open = state.open;
  state = {};
  state.cameras = cameras;
  state.frames = frames;
  state.fault = fault;
  state.open = open;
}
int virtual_cameras_open() { return state.open; }

// OpenNI 2

int oniInitialize(int version) { return version == 2002 ? (handle(), 0) : 1; }
void oniShutdown() { taken_back(); }
int oniGetDeviceList(VirtualDevice** list, int* count) {
  *list = new VirtualDevice[static_cast<std::size_t>(state.cameras)]();
  for (int k = 0; k < state.cameras; ++k)
    std::memcpy((*list)[k].uri.data(), k == 0 ? "virtual/0" : "virtual/1", 10);
  *count = state.cameras;
  handle();
  return 0;
}
int oniReleaseDeviceList(VirtualDevice* list) {
  delete[] list;
  taken_back();
  return 0;
}
int oniDeviceOpen(const char* uri, void** device) {
  return std::strncmp(uri, "virtual/", 8) == 0 ? given(device) : 6;
}
int oniDeviceClose(void*) {
  taken_back();
  return 0;
}
int oniDeviceSetProperty(void*, int property, const void* data, int size) {
  int value = 0;
  if (property != 5 || size != sizeof value) return 3;
  std::memcpy(&value, data, sizeof value);
  state.is_registered = value == 1;
  return 0;
}
int oniDeviceCreateStream(void*, int sensor, void** stream) {
  if (sensor == 2 && state.fault == 5) return 3;
  handle();
  *stream = &streams[sensor == 3 ? 0 : 1];
  return 0;
}
void oniStreamDestroy(void*) { taken_back(); }
int oniStreamStart(void*) {
  handle();
  return 0;
}
void oniStreamStop(void*) { taken_back(); }
int oniStreamSetProperty(void*, int property, const void* data, int) {
  int value = 0;
  std::memcpy(&value, data, sizeof value);
  if (property == 7) state.is_mirrored = value != 0;
  return 0;
}
int oniStreamGetProperty(void*, int property, void* data, int* size) {
  // A focal length of 500 px.
  const float angle = 2.0F * std::atan((property == 1 ? 320.0F : 240.0F) / 500.0F);
  if (*size != sizeof angle || (property != 1 && property != 2)) return 4;
  std::memcpy(data, &angle, sizeof angle);
  return 0;
}
int oniWaitForAnyStream(void** stream, int, int* which, int timeout_ms) {
  *which = 0;
  if (*stream == &streams[1]) return state.is_registered ? 0 : 102;
  const Came came = wait(timeout_ms);
  return came == Came::frame ? 0 : came == Came::nothing ? 102 : 6;
}
int oniStreamReadFrame(void* stream, VirtualOniFrame** frame) {
  handle();
  *frame = new VirtualOniFrame{};
  VirtualOniFrame& made = **frame;
  const bool is_depth = stream == &streams[0];
  made.index = 100 + state.number;
  made.width = state.fault == 3 ? 1 << 20 : kWidth;
  made.height = state.fault == 3 ? 1 << 20 : kHeight;
  made.mode[0] = !is_depth ? 200 : state.fault == 2 ? 102 : 100;
  made.stride = kWidth * (is_depth ? 2 : 3);
  made.bytes = made.stride * (state.fault == 4 ? kHeight - 1 : kHeight);
  made.depths = depths();
  made.colours = colours();
  made.data = is_depth ? static_cast<void*>(made.depths.data()) : made.colours.data();
  if (state.fault == 1) made.data = nullptr;
  return 0;
}
void oniFrameRelease(VirtualOniFrame* frame) {
  delete frame;
  taken_back();
}
const char* oniGetExtendedError() { return state.frames == 0 ? "the device was unplugged\nat once" : ""; }

// libfreenect

int freenect_init(void** context, void*) { return given(context); }
int freenect_shutdown(void*) {
  taken_back();
  return 0;
}
void freenect_set_log_level(void*, int) {}
void freenect_select_subdevices(void*, int) {}
int freenect_num_devices(void*) { return state.cameras; }
int freenect_open_device(void*, void** device, int) { return given(device); }
int freenect_close_device(void*) {
  taken_back();
  return 0;
}
VirtualMode freenect_find_depth_mode(int resolution, int format) {
  return mode(format == 4 ? resolution : 0, format, 2);
}
VirtualMode freenect_find_video_mode(int resolution, int format) { return mode(resolution, format, 3); }
int freenect_set_depth_mode(void*, VirtualMode wanted) { return wanted.is_valid == 1 ? 0 : -1; }
int freenect_set_video_mode(void*, VirtualMode wanted) { return wanted.is_valid == 1 ? 0 : -1; }
void freenect_set_depth_callback(void*, Callback callback) { callbacks[0] = callback; }
void freenect_set_video_callback(void*, Callback callback) { callbacks[1] = callback; }
int freenect_start_depth(void*) {
  state.is_mirrored = false;
  handle();
  return 0;
}
int freenect_start_video(void*) {
  handle();
  return 0;
}
int freenect_stop_depth(void*) {
  taken_back();
  return 0;
}
int freenect_stop_video(void*) {
  taken_back();
  return 0;
}
int freenect_process_events_timeout(void* context, timeval* longest) {
  const Came came = wait(static_cast<int>(longest->tv_sec * 1000 + longest->tv_usec / 1000));
  if (came == Came::lost) return -1;
  if (came == Came::nothing) return 0;
  auto colour = colours();
  auto depth = depths();
  if (callbacks[1] != nullptr && state.fault != 5) callbacks[1](context, colour.data(), 0);
  if (callbacks[0] != nullptr) callbacks[0](context, state.fault == 1 ? nullptr : depth.data(), 0);
  return 0;
}

// librealsense 2

int rs2_get_api_version(void**) { return 25600; }
void* rs2_create_context(int version, void** error) {
  if (version != 25600) return fail(error), nullptr;
  return handle();
}
void rs2_delete_context(void*) { taken_back(); }
void* rs2_query_devices(void*, void**) { return handle(); }
int rs2_get_device_count(void*, void**) { return state.cameras; }
void* rs2_create_device(void*, int, void**) { return handle(); }
const char* rs2_get_device_info(void*, int what, void**) { return what == 1 ? "0123456789" : "virtual"; }
void rs2_delete_device(void*) { taken_back(); }
void rs2_delete_device_list(void*) { taken_back(); }
void* rs2_create_pipeline(void*, void**) { return handle(); }
void rs2_delete_pipeline(void*) { taken_back(); }
void* rs2_create_config(void**) {
  has_colours = false;
  return handle();
}
void rs2_delete_config(void*) { taken_back(); }
void rs2_config_enable_device(void*, const char* serial, void** error) {
  if (std::strcmp(serial, "0123456789") != 0) fail(error);
}
void rs2_config_enable_stream(void*, int stream, int, int, int, int format, int, void** error) {
  if (stream == 2) has_colours = true;
  if ((stream == 1 && format != 1) || (stream == 2 && format != 5)) fail(error);
}
void* rs2_pipeline_start_with_config(void*, void*, void** error) {
  if (has_colours && state.fault == 5) return fail(error), nullptr;
  state.is_mirrored = is_aligned = false;
  return handle();
}
void rs2_delete_pipeline_profile(void*) { taken_back(); }
void rs2_pipeline_stop(void*, void**) {}
int rs2_pipeline_try_wait_for_frames(void*, void** frames, unsigned longest_ms, void** error) {
  const Came came = wait(static_cast<int>(longest_ms));
  if (came == Came::lost) return fail(error);
  if (came == Came::nothing) return 0;
  handle();
  *frames = new VirtualRsFrame;
  return 1;
}
void* rs2_create_align(int to, void** error) {
  if (to != 2) return fail(error), nullptr;
  return handle();
}
void rs2_delete_processing_block(void*) { taken_back(); }
void* rs2_create_frame_queue(int, void**) { return handle(); }
void rs2_delete_frame_queue(void*) { taken_back(); }
void rs2_start_processing_queue(void*, void*, void**) {}
void rs2_process_frame(void*, void* frame, void**) {
  in_queue = static_cast<VirtualRsFrame*>(frame);
  is_aligned = true;
}
int rs2_try_wait_for_frame(void*, unsigned, void** frame, void**) {
  *frame = in_queue;
  return in_queue == nullptr ? 0 : 1;
}
int rs2_embedded_frames_count(void*, void**) { return has_colours ? 2 : 1; }
void* rs2_extract_frame(void*, int k, void**) {
  handle();
  return new VirtualRsFrame{k == 0 ? 1 : 2, depths(), colours()};
}
void rs2_release_frame(void* frame) {
  delete static_cast<VirtualRsFrame*>(frame);
  taken_back();
}
const void* rs2_get_frame_data(void* frame, void**) {
  const auto& made = *static_cast<VirtualRsFrame*>(frame);
  if (state.fault == 1) return nullptr;
  return made.stream == 1 ? static_cast<const void*>(made.depths.data()) : made.colours.data();
}
int rs2_get_frame_width(void*, void**) { return state.fault == 3 ? 1 << 20 : kWidth; }
int rs2_get_frame_height(void*, void**) { return state.fault == 3 ? 1 << 20 : kHeight; }
int rs2_get_frame_stride_in_bytes(void* frame, void**) {
  return kWidth * (static_cast<VirtualRsFrame*>(frame)->stream == 1 ? 2 : 3);
}
int rs2_get_frame_data_size(void* frame, void** error) {
  return rs2_get_frame_stride_in_bytes(frame, error) * (state.fault == 4 ? kHeight - 1 : kHeight);
}
std::uint64_t rs2_get_frame_number(void*, void**) { return static_cast<std::uint64_t>(1000 + state.number); }
float rs2_depth_frame_get_units(void*, void**) { return state.fault == 2 ? 0.0F : 0.001F; }
void* rs2_get_frame_stream_profile(void* frame, void**) {
  return &profiles[static_cast<std::size_t>(static_cast<VirtualRsFrame*>(frame)->stream)];
}
void rs2_get_stream_profile_data(void* profile, int* stream, int* format, int* index, int* id, int* rate_hz,
                                 void**) {
  *stream = profile == &profiles[1] ? 1 : 2;
  *format = *stream == 1 ? 1 : 5;
  *index = *id = 0;
  *rate_hz = 30;
}
void rs2_get_video_stream_intrinsics(void*, VirtualIntrinsics* stated, void**) {
  *stated = {kWidth, kHeight, 320.5F, 239.5F, is_aligned || !has_colours ? 500.0F : 400.0F, 500.0F, 0, {}};
}
const char* rs2_get_error_message(void*) { return "the device was unplugged\nat once"; }
void rs2_free_error(void*) { taken_back(); }
}
