// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/relief/relief_in_window.hpp"
#include "palpable/session/touch/robot_control.hpp"
#include "palpable/sources/stereo/stereo_file.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace palpable::session {

/// One frame of a live source.
struct LiveFrame {
  /// Counted from 0 with every frame that arrived, also those that were never taken.
  std::uint64_t number = 0;
  std::chrono::steady_clock::time_point arrival;
  DepthMap depth;
  /// Where the camera was, as the source states it: a pose, or odometry, which drifts. nullopt: not stated.
  std::optional<Transform<WorldFrame, CameraFrame>> world_from_camera = {};
  /// When it was taken, by the source's clock, s; nullopt: not stated.
  std::optional<double> stamp_s = {};
};

/// What a live source shows now.
struct SeenView {
  /// The surface, with one sample for each depth.
  const models::Relief& relief;
  const Raster<float>& depth_m;
  /// The camera that sees it so; nullopt if it is not stated, or if the view is shown from elsewhere.
  std::optional<Pinhole> camera;
  /// How the relief was made.
  const sculpt::WindowedReliefOptions& shape;
};

class TouchSession;

/// The method (models::SceneSource) of a surface that live pictures show.
inline constexpr std::string_view kLiveMethod = "live depth";

/// A source of frames that arrive whether they are taken or not. One thread takes them.
class LiveSource {
 public:
  LiveSource() = default;
  virtual ~LiveSource() = default;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  /// The newest frame that has not been taken; waits for one until `deadline`. nullopt: none came, or the
  /// source has ended. Errors: invalid_input for a frame that cannot be read; the next call goes on with the
  /// next frame.
  virtual Result<std::optional<LiveFrame>> take(std::chrono::steady_clock::time_point deadline) = 0;
  virtual bool has_ended() const = 0;
  /// The colour picture of the frame that was taken last; nullopt if there is none.
  virtual std::optional<Image> colour() = 0;
  /// A sentence that a camera was lost, if that is new; it is said once for each loss, and the source goes
  /// on.
  virtual std::optional<std::string> loss() { return std::nullopt; }
  /// Another sentence for the user, if there is a new one.
  virtual std::optional<std::string> notice() { return std::nullopt; }
  /// Its frames of depth are recorded by who takes them; else its pictures are by itself.
  virtual bool gives_depths() const { return true; }
  /// "depth camera", for titles.
  virtual std::string_view kind() const { return "depth camera"; }
  /// Whether it may mark the direction of a sound.
  virtual bool marks_sounds() const { return false; }
  /// Gives the pixels from which a sound is heard now this label; labels of the camera's size.
  virtual void mark_sound(Raster<std::uint8_t>& /*labels*/, std::uint8_t /*label*/,
                          const Pinhole& /*camera*/) {}
  /// The noise of its depth, after the first frame.
  virtual vision::DepthNoise noise() const { return {}; }
  /// What is touched now instead of the surface that was seen last, of its size in metres; null: that
  /// surface.
  virtual std::shared_ptr<const models::Relief> surface(const SeenView& /*seen*/) { return nullptr; }
  /// The way along which the hand is pulled in a scene that is handed over next.
  virtual std::shared_ptr<const models::RouteGuide> guide(const models::Scene& scene) { return scene.guide; }
  /// The robot whose camera this is; null: none.
  virtual RobotControl* robot() { return nullptr; }
  /// The touch that it feeds, until end().
  virtual void begin(TouchSession& /*session*/) {}
  /// Ends a take() that is going on; no other follows. After begin(), any thread.
  virtual void cancel() {}
  virtual void end() {}
};

/// How the pairs of a live stereo camera are taken and matched.
struct LivePairOptions {
  /// As in matched_source().
  std::optional<StereoRig> rig = {};
  /// How one picture holds a pair.
  sources::StereoLayout layout = sources::StereoLayout::automatic;
  /// The folder to which the pairs of a stereo camera are recorded (recorded_pairs()); empty: none.
  std::filesystem::path record_to = {};
};

/// Opens a live source (live_address.hpp): the frames of a folder, paced as from a camera, a stereo
/// camera, a depth camera of this machine or of a rosbridge server, or a robot. Pairs are matched
/// (matched_source()) with `options` and `work`. Errors: parse_live_address(); invalid_input as
/// sources::FrameFolder::open(), sources::connect_http_camera(), sources::connect_stream_camera(),
/// sources::open_video_device(),
/// sources::RosbridgeClient::open() and open_robot_source(); as sources::open_depth_camera(); as
/// recorded_pairs(), and usage for frames of depth in a folder that shall be recorded.
Result<std::unique_ptr<LiveSource>> open_live_source(const std::string& address,
                                                     const LivePairOptions& options, const Work& work);

}  // namespace palpable::session
