// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/host.hpp"

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>

namespace palpable::page::shelf {

/// A scene whose touch is to begin.
struct TouchRequest {
  std::shared_ptr<const models::Scene> scene;
  /// Its name, also of the file that the page saves it to.
  std::string name;
  /// Called once per frame on the server's thread: a finer scene if one is ready, else null. Never empty.
  std::function<std::shared_ptr<const models::Scene>()> take_better_scene;
  /// Whether a finer scene is being made.
  bool better_follows = false;
  /// Keeps the scene with its names as they are now. Any thread. Never empty.
  std::function<Result<void>(const models::Scene&)> keep;
  /// What the person should know of the scene, in English: said as the touch begins.
  std::vector<std::string> notes;
};

/// Opens the device and begins a touch, which ends when its host is destroyed. Blocks. Errors: as
/// session::TouchSession::open().
using BeginTouch = std::function<Result<std::shared_ptr<PageHost>>(const TouchRequest& request)>;

/// The one touch of a home page: the device serves one scene at a time. Any thread.
class TouchSlot {
 public:
  explicit TouchSlot(BeginTouch begin) : begin_(std::move(begin)) {}

  /// The touch that pages show now; null: none.
  std::shared_ptr<PageHost> current() const;
  /// The name of its scene; empty: none.
  std::string name() const;
  /// Ends the current touch, waits until the server has released it, and begins another one. Blocks. After an
  /// error there is none. Errors: those of BeginTouch.
  Result<void> replace(const TouchRequest& request);

 private:
  BeginTouch begin_;
  /// Held while a touch ends and another one begins.
  std::mutex replacing_;
  /// When the touch that was begun last has been destroyed; only with replacing_ held.
  std::future<void> ended_;
  mutable std::mutex mutex_;
  std::shared_ptr<PageHost> touch_;
  std::string name_;
};

}  // namespace palpable::page::shelf
