// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/core/work.hpp"
#include "palpable/session/touch/live_source.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palpable::session {

/// Where a viewer's head is in a depth picture.
struct SeenHead {
  /// The middle between the eyes, from the camera, metres along the axes of an upright screen: x right as the
  /// viewer sees it, y up, z from the screen to the viewer.
  Vec3 eyes_m;
  /// Heads in the picture, at least 1.
  int heads = 1;
};

/// What a depth picture, or the lack of one, says of the viewer's head.
struct HeadNews {
  enum class Pictures : std::uint8_t { come, missing, ended };
  Pictures pictures = Pictures::come;
  /// When the picture came.
  std::chrono::steady_clock::time_point taken;
  /// nullopt: there is none.
  std::optional<SeenHead> head;
};

/// Finds the head of the viewer in the pictures of a depth camera, on a thread of its own, while somebody
/// follows it. Of a picture nothing is kept but this place. All calls from any thread.
class HeadFeed {
 public:
  /// Without a new picture for so long, they are missing.
  static constexpr double kMissing_s = 1.0;

  explicit HeadFeed(std::unique_ptr<LiveSource> source);
  ~HeadFeed();
  HeadFeed(const HeadFeed&) = delete;
  HeadFeed& operator=(const HeadFeed&) = delete;

  /// `down_rad`: how far the camera looks down.
  void follow(bool follows, double down_rad);
  /// What is newer than the last call; nullopt: nothing.
  std::optional<HeadNews> take_news();
  /// A sentence for the user, each once.
  std::optional<std::string> take_notice();

 private:
  void run();
  bool wait_until_followed();
  void look_at(const LiveFrame& frame);
  void put(const HeadNews& news);
  void put_notice(std::string sentence);

  std::unique_ptr<LiveSource> source_;
  std::atomic<double> down_rad_{0.0};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  bool follows_ = false;
  std::optional<HeadNews> news_;
  std::optional<std::string> notice_;
  /// Used by the thread alone.
  struct Finding;
  std::unique_ptr<Finding> finding_;
  std::thread thread_;
};

/// Opens the depth camera that looks at the viewer: frames:, openni:, freenect:, realsense: or ros:
/// (live_address.hpp). Errors: usage for another source; as open_live_source().
Result<std::unique_ptr<HeadFeed>> open_head_feed(const std::string& address, const Work& work);

}  // namespace palpable::session
