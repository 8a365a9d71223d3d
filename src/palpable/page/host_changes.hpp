// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/host.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::page {

/// An encoded frame, shared by all pages that receive it.
struct Frame {
  std::string bytes;
  bool binary = false;
};
using SharedFrame = std::shared_ptr<const Frame>;

template <class Message>
SharedFrame text_frame(const Message& message);

/// What the pages of a host must be sent: everything at first, then what has changed, except the states of
/// the probes. One thread.
class HostChanges {
 public:
  /// `host` must outlive this.
  explicit HostChanges(PageHost& host) : host_(host) {}

  /// For a page that has just been opened; `page` is its number (`hello.page`), `guest` whose page it is.
  std::vector<SharedFrame> everything(std::int64_t page, const std::optional<protocol::Guest>& guest = {});
  /// The notices since the last call.
  std::vector<protocol::Notice> notices();
  /// What has changed since the last call or everything(): scene, settings, materials,
  /// robot.
  std::vector<SharedFrame> changes();

 private:
  void show(const std::shared_ptr<const PageScene>& scene);

  PageHost& host_;
  std::shared_ptr<const PageScene> shown_;
  std::vector<SharedFrame> scene_frames_;
  protocol::Settings sent_settings_;
  protocol::Materials sent_materials_;
  std::optional<protocol::Robot> sent_robot_;
};

}  // namespace palpable::page
