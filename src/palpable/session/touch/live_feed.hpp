// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/haptics/servo/latency_recorder.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/sculpt/relief/relief_in_window.hpp"
#include "palpable/session/touch/live_memory.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/session/touch/recorded_depths.hpp"
#include "palpable/session/touch/touch_statistics.hpp"
#include "palpable/vision/depth_camera/depth_range.hpp"
#include "palpable/vision/depth_camera/steady_depth.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace palpable::session {

class TouchSession;

/// Whether what left the picture stays under the hand (live_memory.hpp).
enum class Memory : std::uint8_t { off, on };

/// How the frames of a depth camera become the surface under the hand. The defaults are the same for every
/// camera.
struct LiveOptions {
  vision::SteadyDepthOptions steady;
  sculpt::WindowedReliefOptions relief;
  /// Depths that the relief shows; not given: vision::FollowedRange.
  std::optional<vision::DepthRange> range;
  /// Frames are reduced by a whole factor until their longer side has at most this many pixels: at 30 frames
  /// a second a ball's surface of more cannot be computed in time on two processors. 16 ... 2048.
  int longest_side_px = 240;
  /// The duration of the change from one frame's surface to the next: with 30 frames a second it moves all
  /// the time. Seconds, 0.005 ... 1.
  double fade_s = 0.03;
  /// A surface that is older counts as lost or late, and a sentence says so. Seconds, 0.1 ... 60.
  double lost_s = 1.0;
  /// For this time a first depth is waited for. Seconds, 0.1 ... 600.
  double first_s = 10.0;
  /// The folder to which frames of depth are recorded (DepthRecorder); empty: none. Pairs of a stereo camera
  /// are recorded by their source.
  std::filesystem::path record_to = {};
  Memory memory = Memory::off;
  /// Its map's noise is that of `steady`.
  LiveMemoryOptions remembered;
};

/// Errors: usage for a value out of range.
Result<void> check(const LiveOptions& options);

/// What a sentence is about: the pictures, or the state of a robot, which the page shows and says by itself.
enum class LiveSubject : std::uint8_t { pictures, robot };

/// Feeds a touch from a live source: each frame becomes a scene, which takes the place of the one before.
/// Frames that come faster than they can be used are left out, the oldest first.
class LiveFeed {
 public:
  /// Takes sentences for the user; called by the feed's threads, one at a time.
  using Say = std::function<void(const std::string&, LiveSubject)>;

  /// Waits for the first frame with a known depth, for LiveOptions::first_s. Errors: as check(),
  /// LiveSource::take(), sculpt::relief_in_window() and DepthRecorder::open(); invalid_input if none comes;
  /// interrupted.
  static Result<std::unique_ptr<LiveFeed>> open(std::unique_ptr<LiveSource> source,
                                                const LiveOptions& options, const Work& work);
  ~LiveFeed();
  LiveFeed(const LiveFeed&) = delete;
  LiveFeed& operator=(const LiveFeed&) = delete;

  /// The scene of the first frame, with a title that says that it is live.
  const std::shared_ptr<const models::Scene>& first_scene() const { return first_; }
  /// Feeds `session`, which must have the first scene, on a thread of its own until stop(). Once. Materials,
  /// names and title that the session's scene has by then, or gets, stay.
  void start(TouchSession& session, Say say);
  /// Before the session ends.
  void stop();
  LiveStatistics statistics() const;
  /// LiveSource::robot().
  RobotControl* robot() const { return source_->robot(); }

 private:
  using Clock = std::chrono::steady_clock;

  LiveFeed(std::unique_ptr<LiveSource> source, const LiveOptions& options);
  /// What is felt of a frame; without relief before any depth is known.
  struct Surface {
    std::shared_ptr<const models::Relief> relief;
    /// Empty without memory.
    Raster<std::uint8_t> labels;
  };

  void prepare(const LiveFrame& first);
  Result<Surface> surface_of(const LiveFrame& frame);
  void begin_with(Surface surface);
  void learn();
  Result<void> begin_recording();
  void record(const LiveFrame& frame);
  void read_picture();
  void refresh_texture(models::Scene& scene);
  void run(TouchSession& session);
  void feel(TouchSession& session, const LiveFrame& frame);
  /// Why a surface is old: its camera was lost, its pictures come too late, or they are used too slowly.
  enum class Old : std::uint8_t { lost, late, slow };
  void call_old(const std::string& sentence, Old why);
  std::optional<Old> end_old(double current_s);
  bool is_called_old() const;
  void watch();
  double age_s() const;
  bool is_slow() const;
  void say(const std::string& sentence, LiveSubject subject = LiveSubject::pictures);

  std::unique_ptr<LiveSource> source_;
  LiveOptions options_;
  vision::SteadyDepth steady_;
  /// Null: nothing is remembered.
  std::unique_ptr<LiveMemory> memory_;
  /// Null: frames are not recorded.
  std::unique_ptr<DepthRecorder> recorder_;
  /// The newest colour picture, if it was not recorded yet.
  std::optional<Image> unrecorded_colour_;
  Clock::time_point first_arrival_;
  vision::FollowedRange range_;
  std::shared_ptr<const models::Scene> first_;
  Clock::time_point last_arrival_;
  Clock::time_point last_picture_;
  bool has_picture_ = false;
  std::optional<Raster<Rgb8>> new_texture_;
  bool said_unknown_ = false;
  std::atomic<bool> ending_{false};
  /// The source has ended.
  std::atomic<bool> ended_{false};
  /// When the source was asked for the frame that is waited for or read now; the clock's beginning: it is
  /// not.
  std::atomic<Clock::time_point> asked_{Clock::time_point{}};
  std::mutex say_mutex_;
  Say say_;
  /// Guards what statistics() and watch() read.
  mutable std::mutex mutex_;
  Clock::time_point begin_;
  Clock::time_point newest_felt_;
  /// When a sentence said that the surface is old, if no newer picture is felt yet.
  std::optional<Clock::time_point> old_since_;
  Old old_ = Old::late;
  std::uint64_t arrived_ = 0;
  std::optional<MemoryStatistics> memory_statistics_;
  /// From the arrival of the newest felt frame to the first force that knows it.
  double newest_latency_s_ = 0.0;
  haptics::LatencyRecorder latencies_;
  std::thread thread_;
  /// Says when the surface is old, also while the other thread waits for the source.
  std::thread watcher_;
};

/// Feeds a session, if there is a feed, for as long as this object lives.
class Feeding {
 public:
  Feeding(LiveFeed* feed, TouchSession& session, LiveFeed::Say say) : feed_(feed) {
    if (feed_ != nullptr) feed_->start(session, std::move(say));
  }
  ~Feeding() {
    if (feed_ != nullptr) feed_->stop();
  }
  Feeding(const Feeding&) = delete;
  Feeding& operator=(const Feeding&) = delete;

 private:
  LiveFeed* feed_;
};

}  // namespace palpable::session
