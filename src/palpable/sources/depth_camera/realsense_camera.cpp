// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth_camera/realsense_camera.hpp"

#include "palpable/sources/depth_camera/camera_pixels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace palpable::sources {
namespace {

// librealsense's C interface, as far as it is used: rs.h and what it includes.
constexpr int kDepthStream = 1, kColourStream = 2;
constexpr int kAnyFormat = 0, kZ16 = 1, kRgb = 5;
constexpr int kSerialNumber = 1;

struct Intrinsics {
  int width, height;
  float ppx, ppy, fx, fy;
  int model;
  std::array<float, 5> coefficients;
};
using Handle = void*;
using Fault = Handle*;

struct RealSense {
  int (*rs2_get_api_version)(Fault) = nullptr;
  Handle (*rs2_create_context)(int, Fault) = nullptr;
  void (*rs2_delete_context)(Handle) = nullptr;
  Handle (*rs2_query_devices)(Handle, Fault) = nullptr;
  int (*rs2_get_device_count)(Handle, Fault) = nullptr;
  Handle (*rs2_create_device)(Handle, int, Fault) = nullptr;
  const char* (*rs2_get_device_info)(Handle, int, Fault) = nullptr;
  void (*rs2_delete_device)(Handle) = nullptr;
  void (*rs2_delete_device_list)(Handle) = nullptr;
  Handle (*rs2_create_pipeline)(Handle, Fault) = nullptr;
  void (*rs2_delete_pipeline)(Handle) = nullptr;
  Handle (*rs2_create_config)(Fault) = nullptr;
  void (*rs2_delete_config)(Handle) = nullptr;
  void (*rs2_config_enable_device)(Handle, const char*, Fault) = nullptr;
  void (*rs2_config_enable_stream)(Handle, int, int, int, int, int, int, Fault) = nullptr;
  Handle (*rs2_pipeline_start_with_config)(Handle, Handle, Fault) = nullptr;
  void (*rs2_delete_pipeline_profile)(Handle) = nullptr;
  void (*rs2_pipeline_stop)(Handle, Fault) = nullptr;
  int (*rs2_pipeline_try_wait_for_frames)(Handle, Handle*, unsigned, Fault) = nullptr;
  Handle (*rs2_create_align)(int, Fault) = nullptr;
  void (*rs2_delete_processing_block)(Handle) = nullptr;
  Handle (*rs2_create_frame_queue)(int, Fault) = nullptr;
  void (*rs2_delete_frame_queue)(Handle) = nullptr;
  void (*rs2_start_processing_queue)(Handle, Handle, Fault) = nullptr;
  void (*rs2_process_frame)(Handle, Handle, Fault) = nullptr;
  int (*rs2_try_wait_for_frame)(Handle, unsigned, Handle*, Fault) = nullptr;
  int (*rs2_embedded_frames_count)(Handle, Fault) = nullptr;
  Handle (*rs2_extract_frame)(Handle, int, Fault) = nullptr;
  void (*rs2_release_frame)(Handle) = nullptr;
  const void* (*rs2_get_frame_data)(Handle, Fault) = nullptr;
  int (*rs2_get_frame_data_size)(Handle, Fault) = nullptr;
  int (*rs2_get_frame_width)(Handle, Fault) = nullptr;
  int (*rs2_get_frame_height)(Handle, Fault) = nullptr;
  int (*rs2_get_frame_stride_in_bytes)(Handle, Fault) = nullptr;
  std::uint64_t (*rs2_get_frame_number)(Handle, Fault) = nullptr;
  float (*rs2_depth_frame_get_units)(Handle, Fault) = nullptr;
  Handle (*rs2_get_frame_stream_profile)(Handle, Fault) = nullptr;
  void (*rs2_get_stream_profile_data)(Handle, int*, int*, int*, int*, int*, Fault) = nullptr;
  void (*rs2_get_video_stream_intrinsics)(Handle, Intrinsics*, Fault) = nullptr;
  const char* (*rs2_get_error_message)(Handle) = nullptr;
  void (*rs2_free_error)(Handle) = nullptr;
};

Result<RealSense> load(const std::string& file) {
  const auto library = SharedLibrary::open(file, {"librealsense2.so"});
  if (!library) return library.error();
  RealSense rs;
  Binder bind(*library);
  bind(rs.rs2_get_api_version, "rs2_get_api_version");
  bind(rs.rs2_create_context, "rs2_create_context");
  bind(rs.rs2_delete_context, "rs2_delete_context");
  bind(rs.rs2_query_devices, "rs2_query_devices");
  bind(rs.rs2_get_device_count, "rs2_get_device_count");
  bind(rs.rs2_create_device, "rs2_create_device");
  bind(rs.rs2_get_device_info, "rs2_get_device_info");
  bind(rs.rs2_delete_device, "rs2_delete_device");
  bind(rs.rs2_delete_device_list, "rs2_delete_device_list");
  bind(rs.rs2_create_pipeline, "rs2_create_pipeline");
  bind(rs.rs2_delete_pipeline, "rs2_delete_pipeline");
  bind(rs.rs2_create_config, "rs2_create_config");
  bind(rs.rs2_delete_config, "rs2_delete_config");
  bind(rs.rs2_config_enable_device, "rs2_config_enable_device");
  bind(rs.rs2_config_enable_stream, "rs2_config_enable_stream");
  bind(rs.rs2_pipeline_start_with_config, "rs2_pipeline_start_with_config");
  bind(rs.rs2_delete_pipeline_profile, "rs2_delete_pipeline_profile");
  bind(rs.rs2_pipeline_stop, "rs2_pipeline_stop");
  bind(rs.rs2_pipeline_try_wait_for_frames, "rs2_pipeline_try_wait_for_frames");
  bind(rs.rs2_create_align, "rs2_create_align");
  bind(rs.rs2_delete_processing_block, "rs2_delete_processing_block");
  bind(rs.rs2_create_frame_queue, "rs2_create_frame_queue");
  bind(rs.rs2_delete_frame_queue, "rs2_delete_frame_queue");
  bind(rs.rs2_start_processing_queue, "rs2_start_processing_queue");
  bind(rs.rs2_process_frame, "rs2_process_frame");
  bind(rs.rs2_try_wait_for_frame, "rs2_try_wait_for_frame");
  bind(rs.rs2_embedded_frames_count, "rs2_embedded_frames_count");
  bind(rs.rs2_extract_frame, "rs2_extract_frame");
  bind(rs.rs2_release_frame, "rs2_release_frame");
  bind(rs.rs2_get_frame_data, "rs2_get_frame_data");
  bind(rs.rs2_get_frame_data_size, "rs2_get_frame_data_size");
  bind(rs.rs2_get_frame_width, "rs2_get_frame_width");
  bind(rs.rs2_get_frame_height, "rs2_get_frame_height");
  bind(rs.rs2_get_frame_stride_in_bytes, "rs2_get_frame_stride_in_bytes");
  bind(rs.rs2_get_frame_number, "rs2_get_frame_number");
  bind(rs.rs2_depth_frame_get_units, "rs2_depth_frame_get_units");
  bind(rs.rs2_get_frame_stream_profile, "rs2_get_frame_stream_profile");
  bind(rs.rs2_get_stream_profile_data, "rs2_get_stream_profile_data");
  bind(rs.rs2_get_video_stream_intrinsics, "rs2_get_video_stream_intrinsics");
  bind(rs.rs2_get_error_message, "rs2_get_error_message");
  bind(rs.rs2_free_error, "rs2_free_error");
  if (auto bound = std::move(bind).bound(); !bound) return std::move(bound).error();
  return rs;
}

class RealSenseCamera final : public DepthCameraLink {
 public:
  RealSenseCamera(const RealSense& functions, std::chrono::milliseconds silence)
      : rs_(functions), silence_(silence) {}

  ~RealSenseCamera() override {
    if (is_started_) call(rs_.rs2_pipeline_stop, pipeline_);
    if (aligner_ != nullptr) rs_.rs2_delete_processing_block(aligner_);
    if (aligned_ != nullptr) rs_.rs2_delete_frame_queue(aligned_);
    if (pipeline_ != nullptr) rs_.rs2_delete_pipeline(pipeline_);
    if (context_ != nullptr) rs_.rs2_delete_context(context_);
  }

  Result<void> open(const DepthCamera& camera) {
    // The library takes its own version's callers.
    const int version = call(rs_.rs2_get_api_version);
    context_ = call(rs_.rs2_create_context, version);
    const auto serial = serial_of(camera);
    if (!serial) return serial.error();
    pipeline_ = call(rs_.rs2_create_pipeline, context_);
    aligned_ = call(rs_.rs2_create_frame_queue, 1);
    aligner_ = call(rs_.rs2_create_align, kColourStream);
    if (fault_) return *fault_;
    call(rs_.rs2_start_processing_queue, aligner_, aligned_);
    // A camera without colours, or at a slow port, gives its depths alone.
    has_colours_ = start(*serial, true);
    if (!has_colours_) {
      fault_.reset();
      if (!start(*serial, false)) return fault();
    }
    is_started_ = true;
    silence_.end();
    return {};
  }

  Result<std::optional<DepthFrame>> next(std::chrono::milliseconds longest) override {
    Handle frames = nullptr;
    const bool is_there = call(rs_.rs2_pipeline_try_wait_for_frames, pipeline_, &frames,
                               static_cast<unsigned>(longest.count())) != 0;
    if (fault_) return *fault_;
    if (!is_there || frames == nullptr) {
      if (auto checked = silence_.check(); !checked) return std::move(checked).error();
      return std::optional<DepthFrame>();
    }
    if (has_colours_) {
      // The aligner takes the frames over.
      call(rs_.rs2_process_frame, aligner_, std::exchange(frames, nullptr));
      constexpr unsigned kAlign_ms = 1000;
      if (call(rs_.rs2_try_wait_for_frame, aligned_, kAlign_ms, &frames) == 0 || fault_) return fault();
    }
    auto read = frame_of(frames);
    rs_.rs2_release_frame(frames);
    if (read && *read) silence_.end();
    return read;
  }

 private:
  /// Calls a function of the library; keeps the first error that it states.
  template <class Answer, class... Given, class... Passed>
  Answer call(Answer (*function)(Given...), Passed... passed) {
    Handle error = nullptr;
    const auto keep = [&] {
      if (error == nullptr) return;
      const char* text = rs_.rs2_get_error_message(error);
      std::string reason = text == nullptr ? "is refused by its library" : text;
      reason.erase(std::find(reason.begin(), reason.end(), '\n'), reason.end());
      if (!fault_) fault_ = invalid_input(std::move(reason));
      rs_.rs2_free_error(error);
    };
    if constexpr (std::is_void_v<Answer>) {
      function(passed..., &error);
      keep();
    } else {
      const Answer answer = function(passed..., &error);
      keep();
      return answer;
    }
  }
  Error fault() const { return fault_.value_or(invalid_input("is refused by its library")); }

  Result<std::string> serial_of(const DepthCamera& camera) {
    const Handle list = context_ == nullptr ? nullptr : call(rs_.rs2_query_devices, context_);
    if (list == nullptr) return fault();
    const int count = call(rs_.rs2_get_device_count, list);
    std::string serial;
    if (camera.number < count) {
      if (const Handle device = call(rs_.rs2_create_device, list, camera.number); device != nullptr) {
        const char* stated = call(rs_.rs2_get_device_info, device, kSerialNumber);
        serial = stated == nullptr ? "" : stated;
        rs_.rs2_delete_device(device);
      }
    }
    rs_.rs2_delete_device_list(list);
    if (fault_) return *fault_;
    if (serial.empty()) return no_such_camera(camera, count);
    return serial;
  }

  bool start(const std::string& serial, bool with_colours) {
    const Handle config = call(rs_.rs2_create_config);
    if (config == nullptr) return false;
    constexpr int kEach = -1, kAny = 0;
    call(rs_.rs2_config_enable_device, config, serial.c_str());
    call(rs_.rs2_config_enable_stream, config, kDepthStream, kEach, kAny, kAny, kZ16, kAny);
    if (with_colours)
      call(rs_.rs2_config_enable_stream, config, kColourStream, kEach, kAny, kAny, kRgb, kAny);
    const Handle profile = fault_ ? nullptr : call(rs_.rs2_pipeline_start_with_config, pipeline_, config);
    rs_.rs2_delete_config(config);
    if (profile != nullptr) rs_.rs2_delete_pipeline_profile(profile);
    return profile != nullptr && !fault_;
  }

  Result<std::optional<DepthFrame>> frame_of(Handle frames) {
    std::optional<DepthFrame> frame;
    std::optional<Image> colour;
    const int count = call(rs_.rs2_embedded_frames_count, frames);
    for (int k = 0; k < count && !fault_; ++k) {
      const Handle part = call(rs_.rs2_extract_frame, frames, k);
      if (part == nullptr) break;
      int stream = 0, format = kAnyFormat, index = 0, id = 0, rate_hz = 0;
      const Handle profile = call(rs_.rs2_get_frame_stream_profile, part);
      call(rs_.rs2_get_stream_profile_data, profile, &stream, &format, &index, &id, &rate_hz);
      if (stream == kColourStream && format == kRgb) colour = picture_of_pixels(pixels_of(part));
      if (stream == kDepthStream && format == kZ16) {
        auto depth_m = depth_of_pixels(pixels_of(part), call(rs_.rs2_depth_frame_get_units, part));
        if (!depth_m) {
          rs_.rs2_release_frame(part);
          return std::move(depth_m).error();
        }
        const std::uint64_t number = call(rs_.rs2_get_frame_number, part);
        first_ = std::min(first_.value_or(number), number);
        frame = DepthFrame{number - *first_,
                           std::chrono::steady_clock::now(),
                           {*std::move(depth_m), camera_of(profile)},
                           {}};
      }
      rs_.rs2_release_frame(part);
    }
    if (fault_) return *fault_;
    if (frame) frame->colour = std::move(colour);
    return frame;
  }

  LibraryPixels pixels_of(Handle frame) {
    const auto size = [](int stated) { return static_cast<std::size_t>(std::max(0, stated)); };
    return {call(rs_.rs2_get_frame_data, frame), call(rs_.rs2_get_frame_width, frame),
            call(rs_.rs2_get_frame_height, frame), size(call(rs_.rs2_get_frame_stride_in_bytes, frame)),
            size(call(rs_.rs2_get_frame_data_size, frame))};
  }

  /// Its distortion, which is small, is not used.
  std::optional<Pinhole> camera_of(Handle profile) {
    Intrinsics stated{};
    call(rs_.rs2_get_video_stream_intrinsics, profile, &stated);
    if (!(stated.fx > 0.0F && stated.fy > 0.0F)) return std::nullopt;
    return Pinhole{stated.fx, stated.fy, stated.ppx, stated.ppy, stated.width, stated.height};
  }

  RealSense rs_;
  Handle context_ = nullptr, pipeline_ = nullptr, aligner_ = nullptr, aligned_ = nullptr;
  bool has_colours_ = false, is_started_ = false;
  std::optional<Error> fault_;
  std::optional<std::uint64_t> first_;
  Silence silence_;
};

}  // namespace

Result<std::unique_ptr<DepthCameraLink>> open_realsense_camera(const DepthCamera& camera) {
  const auto functions = load(camera.library);
  if (!functions) return functions.error();
  auto link = std::make_unique<RealSenseCamera>(*functions, camera.silence);
  if (auto opened = link->open(camera); !opened) return std::move(opened).error();
  return std::unique_ptr<DepthCameraLink>(std::move(link));
}

}  // namespace palpable::sources
